#pragma once

#include <cstdint>

#include "renderer/base/grid.h"

namespace belvedere {

// Gaussian blur, separable, kernel cut at 4 sigma and normalized, borders replicated. sigma in cells, <= 0 copies.
Grid<float> gaussian_blur(const Grid<float>& values, double sigma);
Grid<float> gaussian_blur(const Grid<float>& values, double sigma_x, double sigma_y);

// Minimum and maximum over a (2 radius + 1)² window, borders replicated; cost independent of the radius (van Herk).
Grid<float> window_minimum(const Grid<float>& values, int radius);
Grid<float> window_maximum(const Grid<float>& values, int radius);

// For every cell the index of the nearest cell with mask != 0 (exact Euclidean, ties to the lower index); cells of an empty
// mask get -1. Felzenszwalb & Huttenlocher 2012.
Grid<std::int32_t> nearest_marked(const Grid<std::uint8_t>& mask);

// Value at a fractional place: x, y in cells, cell centres at whole numbers, borders replicated.
float sample_bilinear(const Grid<float>& values, double x, double y);
// Cubic B-spline (smoothing, C2) of the cells as coefficients.
float sample_bspline(const Grid<float>& values, double x, double y);

}  // namespace belvedere
