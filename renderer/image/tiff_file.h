#pragma once

#include <memory>
#include <string>

#include "base/image.h"
#include "renderer/image/image_file.h"
#include "renderer/image/rows/picture_rows.h"

namespace belvedere {

// Encoded RGB 0…1 as 16-bit tiled TIFF (deflate with predictor), row by row. Values are cut to 0…1 and rounded to the nearest step, no
// dither; NaN is 0. Temporary file, every tile read back and compared, rename. Same values, same bytes. Error(output).
std::unique_ptr<PictureRows> open_tiff16(const std::string& path, int width, int height, const PictureFileOptions& options);
// The most that it holds: a row of tiles.
double tiff16_writer_bytes(int width, int height);
void write_tiff16(const std::string& path, const Grid<glm::vec3>& encoded, const PictureFileOptions& options);

}  // namespace belvedere
