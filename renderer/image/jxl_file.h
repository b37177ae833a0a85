#pragma once

#include <string>

#include "base/image.h"
#include "renderer/image/image_file.h"

namespace belvedere {

// Encoded RGB 0…1 as 16-bit JPEG XL (ISO/IEC 18181) without loss; sRGB where it has no profile. Resolution and notes stand in an Exif box,
// as cameras write them. Values, checks and errors as of write_tiff16 (tiff_file.h); besides, Error(limit) where the picture does not fit
// into memory_budget_bytes(), because the library packs it whole.
void write_jxl16(const std::string& path, const Grid<glm::vec3>& encoded, const PictureFileOptions& options);

// As read_image_info and read_picture of image_io.h; of an animation the first picture.
ImageInfo read_jxl_info(const std::string& path);
Grid<glm::vec3> read_jxl_picture(const std::string& path, Grid<float>* alpha);

}  // namespace belvedere
