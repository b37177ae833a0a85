#pragma once

#include <array>

namespace belvedere {

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
