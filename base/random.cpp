#include "base/random.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/pyramid.h"

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
  SplineWeights s{static_cast<std::int64_t>(base) - 1, bspline_weights(t), 0.0};
  double squares = 0.0;
  for (const double w : s.weight) squares += w * w;
  s.inverse_deviation = 1.0 / std::sqrt(squares);
  return s;
}

constexpr double spacing_per_sigma =
    1.7320508075688772;  // the B-spline's deviation is spacing / sqrt(3)

// The lattice cells around a position.
struct LatticePatch {
  std::array<double, 16> normal{};  // row by row
  std::uint64_t seed = 0;
  std::int64_t x = 0;  // of the first
  std::int64_t y = 0;
  bool known = false;
};

// Consecutive positions mostly lie over the same patch of the lattice, or over one of a few of
// several seeds. Each thread caches some patches by key. They are functions of that key, so the
// cache does not affect results.
const LatticePatch& lattice_patch(std::uint64_t seed, std::int64_t x, std::int64_t y) {
  constexpr std::size_t kept = 64;
  thread_local std::array<LatticePatch, kept> patches;
  const std::uint64_t key = (seed + static_cast<std::uint64_t>(x) * 0xa0761d6478bd642fULL +
                             static_cast<std::uint64_t>(y) * 0xd6e8feb86659fd93ULL) *
                            0x9e3779b97f4a7c15ULL;
  LatticePatch& patch = patches[key >> 58];
  if (patch.known && patch.seed == seed && patch.x == x && patch.y == y) return patch;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      patch.normal[static_cast<std::size_t>(4 * j + i)] = random_normal(seed, x + i, y + j);
  patch.seed = seed;
  patch.x = x;
  patch.y = y;
  patch.known = true;
  return patch;
}

}  // namespace

double gaussian_noise(std::uint64_t seed, double x, double y, double sigma_x, double sigma_y) {
  const SplineWeights sx = spline_weights(x / (sigma_x * spacing_per_sigma));
  const SplineWeights sy = spline_weights(y / (sigma_y * spacing_per_sigma));
  const LatticePatch& patch = lattice_patch(seed, sx.first, sy.first);
  double sum = 0.0;
  for (int j = 0; j < 4; ++j) {
    double row = 0.0;
    for (int i = 0; i < 4; ++i)
      row += sx.weight[i] * patch.normal[static_cast<std::size_t>(4 * j + i)];
    sum += sy.weight[j] * row;
  }
  return sum * sx.inverse_deviation * sy.inverse_deviation;
}

double gaussian_noise(std::uint64_t seed, double x, double y, double sigma) {
  return gaussian_noise(seed, x, y, sigma, sigma);
}

NoiseColumns plan_noise_columns(double x, double step, int count, double sigma) {
  NoiseColumns positions;
  positions.spacing = sigma * spacing_per_sigma;
  if (count <= 0) return positions;
  positions.first_column = spline_weights(x / positions.spacing).first;
  positions.lattice_columns =
      static_cast<int>(spline_weights((x + step * (count - 1)) / positions.spacing).first + 3 -
                       positions.first_column) +
      1;
  positions.columns.resize(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    const SplineWeights s = spline_weights((x + step * k) / positions.spacing);
    NoiseColumns::Column& column = positions.columns[static_cast<std::size_t>(k)];
    column.first = static_cast<int>(s.first - positions.first_column);
    std::copy(s.weight.begin(), s.weight.end(), column.weight);
    column.inverse_deviation = s.inverse_deviation;
  }
  return positions;
}

void gaussian_noise_row(const NoiseColumns& positions, std::uint64_t seed, double y, float* out) {
  const SplineWeights sy = spline_weights(y / positions.spacing);
  // The lattice under this row, summed over y once.
  std::vector<double> lattice(static_cast<std::size_t>(positions.lattice_columns));
  for (int i = 0; i < positions.lattice_columns; ++i) {
    double sum = 0.0;
    for (int j = 0; j < 4; ++j)
      sum += sy.weight[static_cast<std::size_t>(j)] *
             random_normal(seed, positions.first_column + i, sy.first + j);
    lattice[static_cast<std::size_t>(i)] = sum * sy.inverse_deviation;
  }
  for (const NoiseColumns::Column& column : positions.columns) {
    const double* c = lattice.data() + column.first;
    const double sum = column.weight[0] * c[0] + column.weight[1] * c[1] + column.weight[2] * c[2] +
                       column.weight[3] * c[3];
    *out++ = static_cast<float>(sum * column.inverse_deviation);
  }
}

}  // namespace belvedere
