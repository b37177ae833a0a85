#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "renderer/trace/camera.h"

namespace belvedere {

// Filters for parts of a picture: a value depends on neighbours within a stated reach and not on
// where the part was cut, bit for bit. gaussian_blur of renderer/base/filter aligns wide kernels to
// the grid's own corner and would depend on it.

// Two pixels whose distances differ by more than this share lie on different surfaces; sky (+inf)
// is a surface of its own.
inline constexpr float surface_tolerance = 0.03F;
inline bool same_surface(float depth_a_m, float depth_b_m) {
  return depth_a_m == depth_b_m ||
         std::abs(depth_a_m - depth_b_m) <= surface_tolerance * std::min(depth_a_m, depth_b_m);
}

// Gaussian of sigma_px that takes no value from another surface; reach surface_reach_px(sigma_px).
// A sky pixel (depth +inf) takes sky only. Wide kernels read every n-th neighbour, so that the cost
// per pixel does not depend on the size of the print. Pixels outside `wanted` (empty: all) hold 0.
Grid<float> blur_on_surface(const Grid<float>& values, const Grid<float>& depth_m, double sigma_px,
                            PixelRect wanted = {});
int surface_reach_px(double sigma_px);

// Plain Gaussian, borders replicated. Wide kernels use means of square cells aligned to the whole
// picture, hence the origin. Reach: blur_reach_px(sigma_px).
Grid<float> blur_in_picture(const Grid<float>& values, double sigma_px, glm::ivec2 origin_px);
int blur_reach_px(double sigma_px);

// Values of wide pixels at the pixels of a rectangle of the sheet, bilinearly between their
// centres.
Grid<float> enlarge(const WideView& wide, const Grid<float>& values, PixelRect sheet_rect);
// The same at one pixel, only from those wide pixels that lie on the surface at `depth_m`. Where
// none of the four around does (a crest of rock rises above where the wide view saw it), from the
// nearest in their columns; without any, the wide pixel that contains the pixel. Reach:
// surface_look_rows wide pixels up and down.
float value_on_surface(const WideView& wide, const Grid<float>& values, int sheet_x, int sheet_y,
                       float depth_m);
// The nearest wide pixel, up or down, on the surface of a pixel; without any, the one that contains
// the pixel.
std::size_t index_on_surface(const WideView& wide, int sheet_x, int sheet_y, float depth_m);
inline constexpr int surface_look_rows = 18;  // crests rise 4.4 units, of four wide pixels at most
// All wide pixels that may be read for those of a rectangle.
inline PixelRect surface_look(PixelRect asked) {
  return {asked.x0 - 1, asked.y0 - surface_look_rows - 1, asked.x1 + 1,
          asked.y1 + surface_look_rows + 1};
}

}  // namespace belvedere
