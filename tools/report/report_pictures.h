#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere::tools {

// Pictures of terrain for pages: Grid<glm::vec3> of encoded RGB, 0…1.

// The cells of a window; the window lies within the grid.
template <class T>
Grid<T> cut(const Grid<T>& cells, const PixelRect& window) {
  Grid<T> out(window.width(), window.height());
  for (int y = 0; y < out.height(); ++y)
    std::copy_n(cells.row(window.y0 + y) + window.x0, out.width(), out.row(y));
  return out;
}
// Means of n × n cells (fewer at the right and lower rim), n the smallest that brings both sides to
// `longest_px`. n is 1 where they already fit.
struct Reduced {
  Grid<float> cells;
  int factor = 1;
};
Reduced reduce_to(const Grid<float>& cells, int longest_px);

// Shaded relief, no side above longest_px.
Grid<glm::vec3> relief_picture(const Grid<float>& altitude_m, glm::dvec2 cell_m, int longest_px);
// Relief with lowered ground in red and raised ground in blue; the full tint at ±full_m.
Grid<glm::vec3> change_picture(const Grid<float>& before_m, const Grid<float>& after_m,
                               glm::dvec2 cell_m, float full_m, int longest_px);
// Mid grey at 0, black and white at ∓full.
Grid<glm::vec3> signed_picture(const Grid<float>& values, float full);

// A picture no side of which is above longest_px: means as in reduce_to.
Grid<glm::vec3> reduced_picture(const Grid<glm::vec3>& picture, int longest_px);
// 8 bits as 0…1.
Grid<glm::vec3> to_picture(const Grid<Rgb8>& colours);
// One colour per label, the same in every picture; unused_label is near black.
Grid<glm::vec3> label_picture(const Grid<std::uint8_t>& labels);
// Colours of class maps, by class id, for write_palette_png; other numbers are black.
std::vector<std::array<std::uint8_t, 3>> class_map_colours();
// Each pixel as a square of `times` pixels.
Grid<glm::vec3> enlarged(const Grid<glm::vec3>& picture, int times);
// From black at 0 through red and yellow to white at `full` and above.
Grid<glm::vec3> heat_picture(const Grid<float>& values, float full);
// Quantile 0…1; of every n-th value where there are many.
float percentile(const Grid<float>& values, double share);

// The best of square windows of `side` cells (less where the grid is smaller), half a side apart:
// the one with the largest sum of `score`, the first of equals. Windows where the mean of `where`
// is below .5 are ignored while another has more; an empty `where` is 1.
PixelRect best_window(const Grid<float>& score, const Grid<float>& where, int side);

// Text in pictures, in the system's plain font: Error(input) where no fonts are installed.
inline constexpr int text_height = 8;  // of capitals and descenders, px, at scale 1
// Width of the text in pixels.
int text_width(const std::string& text, int scale);
// `x`, `y`: the upper left corner of the first letter; parts outside the picture are cut off.
// Encoded sRGB.
void draw_text(Grid<glm::vec3>& picture, int x, int y, const std::string& text, glm::vec3 colour,
               int scale);

// Captions on sheets of pictures.
inline constexpr int caption_scale = 2;
inline constexpr int caption_line_px = text_height * caption_scale + 6;

// The bytes of a picture file, encoded sRGB: JPEG where it may be quick, PNG where it must be
// exact.
std::string jpeg_bytes(const Grid<glm::vec3>& picture, int quality = 90);
std::string png_bytes(const Grid<glm::vec3>& picture);

// For self-contained pages: a picture of encoded RGB, 0…1, as a data URI:
// "data:image/png;base64,…".
std::string png_address(const Grid<glm::vec3>& picture);

}  // namespace belvedere::tools
