#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "base/grid.h"
#include "renderer/image/image_file.h"
#include "renderer/image/rows/picture_rows.h"

namespace belvedere {

// Loads OpenImageIO if the program is not linked with it (oiio_late.cpp), once; what is below does
// so itself. Throws Error(limit) where it is not installed.
void load_oiio();
// Like read_image_info, read_picture and read_grey of image_io.h; format: "png", "tiff" or "jpeg",
// by its first bytes.
ImageInfo read_oiio_info(const std::string& path, const std::string& format);
Grid<glm::vec3> read_oiio_picture(const std::string& path, const std::string& format,
                                  Grid<float>* alpha);
// The same picture in bands from top to bottom, each with its first row.
void read_oiio_rows(const std::string& path, const std::string& format, const UsePictureRows& use);
Grid<std::uint16_t> read_oiio_grey(const std::string& path, const std::string& format);
// Encoded RGB 0…1 as 8-bit PNG, row by row, marked as sRGB where it has no profile. Values, checks
// and errors as of open_tiff16 (tiff_file.h).
std::unique_ptr<PictureRows> open_png8(const std::string& path, int width, int height,
                                       const PictureFileOptions& options);
// Maximum memory: a band of rows.
double png8_writer_bytes(int width, int height);
void write_png8(const std::string& path, const Grid<glm::vec3>& encoded,
                const PictureFileOptions& options);
// Encoded sRGB as JPEG without profile or notes, for pages; quality 1…100. Error(output).
void write_jpeg(const std::string& path, const Grid<glm::vec3>& encoded, int quality);

}  // namespace belvedere
