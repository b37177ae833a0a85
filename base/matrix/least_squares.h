#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/function_ref.h"
#include "base/matrix/matrix.h"

namespace belvedere {

// Residuals at some values of the unknowns, and their derivatives: a row a residual, a column an
// unknown.
struct Residuals {
  std::vector<double> values;
  Matrix slopes;
};
using ResidualFunction = FunctionRef<Residuals(std::span<const double> at)>;

struct LeastSquaresParameters {
  int max_steps = 60;        // ≥ 1
  double tolerance = 1e-10;  // stops when a step gains less than this share of the cost, ≥ 0
  std::size_t robust = 0;    // so many residuals, from the first, count as ln(1 + r²) (Cauchy)
};
struct LeastSquaresFit {
  std::vector<double> at;
  double cost = 0.0;  // half the sum of r², or of ln(1 + r²)
  int steps = 0;      // taken
};

// The unknowns with the least cost near `start`: Levenberg-Marquardt with Marquardt's scaling of
// each unknown, and iterated weights 1 / (1 + r²) for the robust residuals. Values that are not
// finite are steps that went too far.
LeastSquaresFit fit_least_squares(std::vector<double> start, ResidualFunction function,
                                  const LeastSquaresParameters& parameters = {});

}  // namespace belvedere
