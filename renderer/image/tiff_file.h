#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/grid.h"
#include "renderer/image/icc/press_colour.h"
#include "renderer/image/image_file.h"
#include "renderer/image/rows/picture_rows.h"

namespace belvedere {

// The page that a TIFF is read as: the largest, of several the first; masks of transparency are
// none.
struct TiffPage {
  int index = 0;
  int pages = 1;
  std::vector<int> of_its_size = {};  // pages from 1, itself among them
};
// Error(input) for a camera's raw file, whose pages are previews of what only its SubIFDs have. A
// damaged file has its first page, whose reader says what is wrong.
TiffPage largest_tiff_page(const std::string& path);

// Encoded RGB 0…1 as 16-bit tiled TIFF (deflate with predictor), row by row. Values are clamped to
// 0…1 and rounded to the nearest step, no dither; NaN is 0. Temporary file, every tile read back
// and compared, rename. Same values, same bytes. Error(output).
std::unique_ptr<PictureRows> open_tiff16(const std::string& path, int width, int height,
                                         const PictureFileOptions& options);
// Maximum memory: a row of tiles.
double tiff16_writer_bytes(int width, int height);
void write_tiff16(const std::string& path, const Grid<glm::vec3>& encoded,
                  const PictureFileOptions& options);

// Rows of a picture as inks, pixel by pixel.
using MakeInks = std::function<Grid<Inks>(const Grid<glm::vec3>& rows)>;
// The same as TIFF of CMYK with 8 or 16 bits: rows are passed to `make_inks` as they arrive.
// Memory: rows of four numbers where those of tiff16_writer_bytes have three.
std::unique_ptr<PictureRows> open_tiff_inks(const std::string& path, int width, int height,
                                            int bits, const PictureFileOptions& options,
                                            MakeInks make_inks);

}  // namespace belvedere
