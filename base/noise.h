#pragma once

#include <cstdint>
#include <vector>

namespace belvedere {

// Smooth noise over the plane, mean 0, standard deviation exactly 1 everywhere, a pure function of
// seed and position. It needs no grid and does not depend on resolution or tiles. It is white noise
// on a lattice under a cubic B-spline of spacing sigma·sqrt(3), whose standard deviation is sigma:
// close to white noise under a Gaussian of that sigma. x, y and sigma in the same unit (metres on
// the ground, or pixels).
double gaussian_noise(std::uint64_t seed, double x, double y, double sigma);

// The same with different widths along x and y.
double gaussian_noise(std::uint64_t seed, double x, double y, double sigma_x, double sigma_y);

// The part of gaussian_noise that depends only on the positions x + i · step, i < count. It is the
// same for every row and seed of a grid.
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

// gaussian_noise at those positions of the row y, into out: equal up to rounding, and much cheaper
// if the step is no longer than sigma.
void gaussian_noise_row(const NoiseColumns& positions, std::uint64_t seed, double y, float* out);

}  // namespace belvedere
