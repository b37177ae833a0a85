#pragma once

#include <memory>
#include <string>

#include "base/grid.h"
#include "renderer/image/image_file.h"
#include "renderer/image/rows/picture_rows.h"

namespace belvedere {

// Encoded RGB 0…1 as 16-bit JPEG XL (ISO/IEC 18181), lossless; sRGB where it has no profile.
// Resolution and notes are in an Exif box, as written by cameras. Values, checks and errors as of
// open_tiff16 (tiff_file.h). Rows may come one by one, but the library packs the picture whole:
// Error(limit), before anything is written, where jxl16_writer_bytes are over
// memory_budget_bytes().
std::unique_ptr<PictureRows> open_jxl16(const std::string& path, int width, int height,
                                        const PictureFileOptions& options);
double jxl16_writer_bytes(int width, int height);

// Like read_image_info and read_picture of image_io.h; of an animation the first picture.
ImageInfo read_jxl_info(const std::string& path);
Grid<glm::vec3> read_jxl_picture(const std::string& path, Grid<float>* alpha);

}  // namespace belvedere
