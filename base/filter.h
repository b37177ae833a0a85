#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "base/grid.h"

namespace belvedere {

// Gaussian blur, separable, borders replicated, sigma in cells; sigma <= 0 copies (that axis). Same
// bits for any thread count. Up to 8 cells the kernel is sampled out to 4 sigma and normalized.
// Wider ones halve the resolution first (binomial of variance 1 down, cubic B-spline of variance 1
// up, 2 + 4 sigma_half² = sigma²), so 60 cells on 4096² cost no more than 8. The result then
// differs from the sampled kernel by less than 3e-4 of the range of the values.
Grid<float> gaussian_blur(const Grid<float>& values, double sigma);
Grid<float> gaussian_blur(const Grid<float>& values, double sigma_x, double sigma_y);

// Minimum and maximum over a (2 radius + 1)² window, borders replicated; cost independent of the
// radius (van Herk 1992). radius <= 0 copies.
Grid<float> window_minimum(const Grid<float>& values, int radius);
Grid<float> window_maximum(const Grid<float>& values, int radius);

// For every cell the index of the nearest cell with mask != 0 (exact Euclidean, ties to the lower
// index); cells of an empty mask get -1. Felzenszwalb & Huttenlocher 2012, in integers. The grid
// has fewer than 2^31 cells.
Grid<std::int32_t> nearest_marked(const Grid<std::uint8_t>& mask);

// Value at a fractional position: x, y in cells, cell centres at whole numbers, borders replicated.
float sample_bilinear(const Grid<float>& values, double x, double y);
glm::dvec2 sample_bilinear(const Grid<glm::vec2>& values, double x, double y);
// Cubic B-spline (smoothing, C2) of the cells as coefficients.
float sample_bspline(const Grid<float>& values, double x, double y);

}  // namespace belvedere
