#include "renderer/paint/picture_noise.h"

#include <cmath>

#include "base/parallel.h"
#include "base/pyramid.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr std::size_t memory_size =
    1024;  // lattice values that a GroundNoise caches; a power of two

// The four weights of a uniform cubic B-spline, divided by the square root of the sum of their
// squares.
struct LatticeWeights {
  std::int64_t first;
  std::array<double, 4> weight;
};

LatticeWeights lattice_weights(double position) {
  const double base = std::floor(position);
  const double t = position - base;
  LatticeWeights w{static_cast<std::int64_t>(base) - 1, bspline_weights(t)};
  double squares = 0.0;
  for (const double each : w.weight) squares += each * each;
  const double scale = 1.0 / std::sqrt(squares);
  for (double& each : w.weight) each *= scale;
  return w;
}

// Weights for `count` pixel centres from the absolute pixel `origin` on.
std::vector<LatticeWeights> pixel_weights(int origin, int count, double pixels_per_unit,
                                          double sigma_units) {
  std::vector<LatticeWeights> weights;
  weights.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double position_units = (static_cast<double>(origin) + i + 0.5) / pixels_per_unit;
    weights.push_back(lattice_weights(position_units / (sigma_units * spacing_per_sigma)));
  }
  return weights;
}

}  // namespace

float broken_noise(std::uint64_t seed, float x, float y) {
  const float floor_x = std::floor(x);
  const float floor_y = std::floor(y);
  const auto ix = static_cast<std::int64_t>(floor_x);
  const auto iy = static_cast<std::int64_t>(floor_y);
  const float fx = x - floor_x;
  const float fy = y - floor_y;
  const auto at = [&](std::int64_t a, std::int64_t b) {
    return static_cast<float>(random_bits(seed, a, b) >> 40U) * 0x1.0p-23F - 1.0F;
  };
  const float b = at(ix + 1, iy);
  const float c = at(ix, iy + 1);
  if (fx + fy < 1.0F) {
    const float a = at(ix, iy);
    return 2.0F * (a + (b - a) * fx + (c - a) * fy);
  }
  const float d = at(ix + 1, iy + 1);
  return 2.0F * (d + (c - d) * (1.0F - fx) + (b - d) * (1.0F - fy));
}

Grid<float> make_image_noise(std::uint64_t seed, glm::ivec2 origin_px, int width, int height,
                             double pixels_per_unit, double sigma_x_units, double sigma_y_units) {
  Grid<float> noise(width, height);
  if (noise.empty()) return noise;
  const std::vector<LatticeWeights> columns =
      pixel_weights(origin_px.x, width, pixels_per_unit, sigma_x_units);
  const std::vector<LatticeWeights> rows =
      pixel_weights(origin_px.y, height, pixels_per_unit, sigma_y_units);
  const std::int64_t first_x = columns.front().first;
  const std::int64_t first_y = rows.front().first;
  const auto lattice_columns = static_cast<int>(columns.back().first - first_x + 4);
  const auto lattice_rows = static_cast<int>(rows.back().first - first_y + 4);
  Grid<float> filtered(width, lattice_rows);
  parallel_rows(lattice_rows, [&](int j) {
    std::vector<double> line(static_cast<std::size_t>(lattice_columns));
    for (int i = 0; i < lattice_columns; ++i)
      line[static_cast<std::size_t>(i)] = random_normal(seed, first_x + i, first_y + j);
    float* out = filtered.row(j);
    for (int x = 0; x < width; ++x) {
      const LatticeWeights& w = columns[static_cast<std::size_t>(x)];
      const double* value = line.data() + (w.first - first_x);
      out[x] = static_cast<float>(w.weight[0] * value[0] + w.weight[1] * value[1] +
                                  w.weight[2] * value[2] + w.weight[3] * value[3]);
    }
  });
  parallel_rows(height, [&](int y) {
    const LatticeWeights& w = rows[static_cast<std::size_t>(y)];
    const int j = static_cast<int>(w.first - first_y);
    const std::array<float, 4> weight = {
        static_cast<float>(w.weight[0]), static_cast<float>(w.weight[1]),
        static_cast<float>(w.weight[2]), static_cast<float>(w.weight[3])};
    const float* a = filtered.row(j);
    const float* b = filtered.row(j + 1);
    const float* c = filtered.row(j + 2);
    const float* d = filtered.row(j + 3);
    float* out = noise.row(y);
    for (int x = 0; x < width; ++x)
      out[x] = weight[0] * a[x] + weight[1] * b[x] + weight[2] * c[x] + weight[3] * d[x];
  });
  return noise;
}

GroundNoise::GroundNoise(std::uint64_t seed, double sigma_m)
    : seed_(seed),
      inverse_spacing_(1.0 / (sigma_m * spacing_per_sigma)),
      cell_x_(nowhere),
      cell_y_(nowhere),
      memory_(memory_size, Entry{nowhere, nowhere, 0.0}) {}

double GroundNoise::lattice(std::int64_t x, std::int64_t y) {
  const auto slot = static_cast<std::size_t>(static_cast<std::uint64_t>(x) +
                                             37U * static_cast<std::uint64_t>(y)) &
                    (memory_size - 1);
  Entry& entry = memory_[slot];
  if (entry.x != x || entry.y != y) entry = {x, y, random_normal(seed_, x, y)};
  return entry.value;
}

float GroundNoise::operator()(double x_m, double y_m) {
  const LatticeWeights wx = lattice_weights(x_m * inverse_spacing_);
  const LatticeWeights wy = lattice_weights(y_m * inverse_spacing_);
  if (wx.first != cell_x_ || wy.first != cell_y_) {
    cell_x_ = wx.first;
    cell_y_ = wy.first;
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) cell_[4 * j + i] = lattice(cell_x_ + i, cell_y_ + j);
  }
  double sum = 0.0;
  for (std::size_t j = 0; j < 4; ++j) {
    double row = 0.0;
    for (std::size_t i = 0; i < 4; ++i) row += wx.weight[i] * cell_[4 * j + i];
    sum += wy.weight[j] * row;
  }
  return static_cast<float>(sum);
}

}  // namespace belvedere
