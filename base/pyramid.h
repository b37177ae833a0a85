#pragma once

#include <array>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// Gaussian and Laplacian pyramids (Burt & Adelson 1983) with the 5-tap kernel [.05 .25 .4 .25 .05].
// Any grid size: a level of n cells has a coarser level of (n + 1) / 2, whose cell i lies over cell
// 2 i. Level 0 is the finest; band i holds features of about 2^i to 2^(i+1) cells. Borders are
// extended linearly (2·edge - inner; a single cell is repeated), because replication bends a ramp
// when band weights differ from 1, while a linearly extended ramp has no bands. Values may
// therefore leave their range slightly near borders; clamp shares and masks. All functions are
// linear in their values and give the same bits for any number of threads.

// `level` at half the size.
Grid<float> reduce(const Grid<float>& level);
// A coarser level expanded to width × height, which must reduce to the coarser level's size.
Grid<float> expand(const Grid<float>& coarser, int width, int height);
// Row y of expand(coarser, width, …), for stages that do not need the whole grid; `out` has room
// for width values.
void expand_row(const Grid<float>& coarser, int y, int width, float* out);
// The same by the taps [1 6 1] / 8 of a cubic B-spline at even cells. The kernel's widen curved
// ground by a mean square of 0.8 cells² there and 1 at odd cells, so that its bands alternate from
// cell to cell by a tenth of the curvature; with these it is 1 at both.
void expand_evenly_row(const Grid<float>& coarser, int y, int width, float* out);

struct LaplacianPyramid {
  std::vector<Grid<float>> bands;  // bands[0] is the finest: G_i - expand(G_{i+1})
  Grid<float> base;                // the coarsest Gaussian level
};

// `bands` bands, or fewer if the next level would have less than 2 cells on a side.
LaplacianPyramid make_laplacian_pyramid(const Grid<float>& values, int bands);
// The Gaussian levels of a mask or weight, level 0 first; `levels` of them (small ones may be a
// single cell).
std::vector<Grid<float>> make_gaussian_pyramid(const Grid<float>& values, int levels);
// Maximum number of bands for a grid of this size: the limit of make_laplacian_pyramid.
int max_bands(int width, int height);

// Weights of the four coefficients of a uniform cubic B-spline at a position t in 0…1 after the
// second (their sum is 1), and their derivatives by t.
constexpr std::array<double, 4> bspline_weights(double t) {
  const double u = 1.0 - t;
  return {u * u * u / 6.0, (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
          (4.0 - 6.0 * u * u + 3.0 * u * u * u) / 6.0, t * t * t / 6.0};
}
constexpr std::array<double, 4> bspline_slopes(double t) {
  const double u = 1.0 - t;
  return {-0.5 * u * u, t * (1.5 * t - 2.0), u * (2.0 - 1.5 * u), 0.5 * t * t};
}

}  // namespace belvedere
