#include "base/noise.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/random.h"

namespace belvedere {
namespace {

struct SplineWeights {
  std::int64_t first;  // lattice index of the first of four
  std::array<double, 4> weight;
  double inverse_deviation;  // 1 / sqrt(sum of squares)
};

// Uniform cubic B-spline at fraction t: its four weights sum to 1.
SplineWeights spline_weights(double position) {
  const double base = std::floor(position);
  const double t = position - base;
  const double u = 1.0 - t;
  SplineWeights s{};
  s.first = static_cast<std::int64_t>(base) - 1;
  s.weight = {u * u * u / 6.0, (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0, (4.0 - 6.0 * u * u + 3.0 * u * u * u) / 6.0, t * t * t / 6.0};
  double squares = 0.0;
  for (const double w : s.weight) squares += w * w;
  s.inverse_deviation = 1.0 / std::sqrt(squares);
  return s;
}

constexpr double spacing_per_sigma = 1.7320508075688772;  // the B-spline's deviation is spacing / sqrt(3)

}  // namespace

double gaussian_noise(std::uint64_t seed, double x, double y, double sigma_x, double sigma_y) {
  const SplineWeights sx = spline_weights(x / (sigma_x * spacing_per_sigma));
  const SplineWeights sy = spline_weights(y / (sigma_y * spacing_per_sigma));
  double sum = 0.0;
  for (int j = 0; j < 4; ++j) {
    double row = 0.0;
    for (int i = 0; i < 4; ++i) row += sx.weight[i] * random_normal(seed, sx.first + i, sy.first + j);
    sum += sy.weight[j] * row;
  }
  return sum * sx.inverse_deviation * sy.inverse_deviation;
}

double gaussian_noise(std::uint64_t seed, double x, double y, double sigma) { return gaussian_noise(seed, x, y, sigma, sigma); }

void gaussian_noise_row(std::uint64_t seed, double x, double step, int count, double y, double sigma, float* out) {
  if (count <= 0) return;
  const double spacing = sigma * spacing_per_sigma;
  const SplineWeights sy = spline_weights(y / spacing);
  const std::int64_t first = spline_weights(x / spacing).first;
  const std::int64_t last = spline_weights((x + step * (count - 1)) / spacing).first + 3;
  // The lattice under this row, summed up over y once.
  std::vector<double> columns(static_cast<std::size_t>(last - first + 1));
  for (std::int64_t i = first; i <= last; ++i) {
    double sum = 0.0;
    for (int j = 0; j < 4; ++j) sum += sy.weight[static_cast<std::size_t>(j)] * random_normal(seed, i, sy.first + j);
    columns[static_cast<std::size_t>(i - first)] = sum * sy.inverse_deviation;
  }
  for (int k = 0; k < count; ++k) {
    const SplineWeights sx = spline_weights((x + step * k) / spacing);
    const double* c = columns.data() + (sx.first - first);
    const double sum = sx.weight[0] * c[0] + sx.weight[1] * c[1] + sx.weight[2] * c[2] + sx.weight[3] * c[3];
    out[k] = static_cast<float>(sum * sx.inverse_deviation);
  }
}

}  // namespace belvedere
