#pragma once

#include <cstdint>
#include <vector>

namespace belvedere {

// Smooth noise over the plane, mean 0, deviation exactly 1 at every place, a pure function of seed and place, so it needs no
// grid and does not depend on resolution or tiles. It is white noise on a lattice under a cubic B-spline of spacing
// sigma·sqrt(3), whose standard deviation is sigma: close to white noise under a Gaussian of that sigma.
// x, y and sigma in the same unit (metres on the ground, or pixels).
double gaussian_noise(std::uint64_t seed, double x, double y, double sigma);

// The same with different widths along x and y.
double gaussian_noise(std::uint64_t seed, double x, double y, double sigma_x, double sigma_y);

// What gaussian_noise needs to know of the places x + i · step, i < count, in every row of a grid: it hangs on neither row nor seed.
struct NoiseColumns {
  struct Column {
    int first;                 // lattice column of the first of four, from first_column on
    double weight[4];          // of the B-spline
    double inverse_deviation;  // 1 / sqrt(sum of their squares)
  };
  double spacing = 0.0;  // of the lattice
  std::int64_t first_column = 0;
  int lattice_columns = 0;
  std::vector<Column> columns;
};
// step > 0.
NoiseColumns plan_noise_columns(double x, double step, int count, double sigma);

// gaussian_noise at those places of the row y, into out: equal up to rounding, at a small part of the cost where the step is no longer
// than sigma.
void gaussian_noise_row(const NoiseColumns& places, std::uint64_t seed, double y, float* out);

}  // namespace belvedere
