#pragma once

#include <string>

#include "base/image.h"
#include "renderer/image/image_file.h"

namespace belvedere {

// Encoded RGB 0…1 as 16-bit tiled TIFF (deflate with predictor). Values are cut to 0…1 and rounded to the nearest step, no dither; NaN is
// 0. Temporary file, every pixel read back and compared, rename. Same values, same bytes. Error(output).
void write_tiff16(const std::string& path, const Grid<glm::vec3>& encoded, const PictureFileOptions& options);

}  // namespace belvedere
