#include "terrain/layers/layer_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/lines/bspline.h"
#include "base/random.h"
#include "base/random_streams.h"
#include "terrain/layers/layer_noise.h"

namespace belvedere {
namespace {

constexpr int bump_octaves = 4;

// Cubic B-spline of a grid: its value and its derivatives per cell to the right and down.
struct GridPlace {
  double value = 0.0;
  glm::dvec2 change{0.0};
};

GridPlace smooth_at(const Grid<float>& grid, glm::dvec2 cell) {
  const double x = std::clamp(cell.x, -1.0, static_cast<double>(grid.width()));
  const double y = std::clamp(cell.y, -1.0, static_cast<double>(grid.height()));
  const int x0 = static_cast<int>(std::floor(x));
  const int y0 = static_cast<int>(std::floor(y));
  const std::array<double, 4> wx = bspline_weights(x - x0);
  const std::array<double, 4> wy = bspline_weights(y - y0);
  const std::array<double, 4> dx = bspline_slopes(x - x0);
  const std::array<double, 4> dy = bspline_slopes(y - y0);
  GridPlace out;
  for (int j = 0; j < 4; ++j) {
    double row = 0.0;
    double row_change = 0.0;
    for (int i = 0; i < 4; ++i) {
      const double value = grid.clamped(x0 - 1 + i, y0 - 1 + j);
      row += wx[static_cast<std::size_t>(i)] * value;
      row_change += dx[static_cast<std::size_t>(i)] * value;
    }
    out.value += wy[static_cast<std::size_t>(j)] * row;
    out.change.x += wy[static_cast<std::size_t>(j)] * row_change;
    out.change.y += dy[static_cast<std::size_t>(j)] * row;
  }
  return out;
}

}  // namespace

std::uint64_t seed_of_name(const std::string& name) {
  std::uint64_t h = 0;
  for (const char c : name)
    h = mix_bits(h ^ static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  return h;
}

LayerNoise bump_noise(double length_m) { return {length_m, bump_octaves, 1.0, 0.0}; }

std::uint64_t bump_seed(const SurfaceLayer& layer, std::uint64_t seed) {
  return stream_seed(seed, Stream::class_noise, ~seed_of_name(layer.name));
}

glm::dvec2 bump_slope(const GroundRelief& relief, glm::dvec2 position_m, double pixel_m) {
  glm::dvec2 slope(0.0);
  for (const GroundRelief::Bumps& bumps : relief.bumps) {
    // None of them is longer than a pixel.
    if (!(bumps.length_m > pixel_m) || bumps.share.empty()) continue;
    const GridPlace share =
        smooth_at(bumps.share, relief.transform.to_cell(position_m.x, position_m.y));
    const glm::dvec2 share_slope(share.change.x / relief.transform.cell_x,
                                 -share.change.y / relief.transform.cell_y);
    if (!(share.value > 0.0) && share_slope == glm::dvec2(0.0)) continue;
    const NoiseAtPosition noise =
        layer_noise_at(bump_noise(bumps.length_m), bumps.seed, position_m, pixel_m);
    slope += bumps.height_m * (share.value * noise.slope + noise.value * share_slope);
  }
  return slope;
}

}  // namespace belvedere
