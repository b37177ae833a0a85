#pragma once

#include <cstdint>

namespace belvedere {

// Smooth noise over the plane, mean 0, deviation exactly 1 at every place, a pure function of seed and place, so it needs no
// grid and does not depend on resolution or tiles. It is white noise on a lattice under a cubic B-spline of spacing
// sigma·sqrt(3), whose standard deviation is sigma: close to white noise under a Gaussian of that sigma.
// x, y and sigma in the same unit (metres on the ground, or pixels).
double gaussian_noise(std::uint64_t seed, double x, double y, double sigma);

// The same with different widths along x and y.
double gaussian_noise(std::uint64_t seed, double x, double y, double sigma_x, double sigma_y);

// gaussian_noise at the `count` places x + i · step of one row, into out: equal up to rounding, at a tenth of the cost where the step
// is no longer than sigma. step > 0.
void gaussian_noise_row(std::uint64_t seed, double x, double step, int count, double y, double sigma, float* out);

}  // namespace belvedere
