#include "terrain/cover/rule_ground.h"

#include <algorithm>

#include "base/filter.h"
#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr std::uint64_t ragged_index =
    4;  // of the stream of class noise; the rules' own noise has 0 … 3
constexpr double ragged_cells = 5.0;   // standard deviation of the noise
constexpr double ragged_share = 0.35;  // of the collar, deviation of the line at its centre

void cut(Grid<float>& grid, const PixelRect& cells) {
  if (!grid.empty()) grid = part_of(grid, cells);
}

}  // namespace

RuleGround part_of(RuleGround ground, const PixelRect& cells) {
  for (Grid<float>& input : ground.inputs) cut(input, cells);
  cut(ground.ice_km2, cells);
  cut(ground.ice_surface_m, cells);
  const glm::dvec2 first = ground.transform.to_crs(cells.x0 - 0.5, cells.y0 - 0.5);
  ground.transform.origin_x = first.x;
  ground.transform.origin_y = first.y;
  return ground;
}

Grid<float> own_share(const RuleAround& around, const GeoTransform& transform, int width,
                      int height, std::uint64_t seed) {
  Grid<float> share(width, height);
  const glm::dvec2 first = transform.to_crs(0.0, 0.0);
  const NoiseColumns noise =
      plan_noise_columns(first.x, transform.cell_x, width, ragged_cells * transform.cell_x);
  parallel_ranges(height, 16, [&](int begin, int end) {
    std::vector<float> ragged(static_cast<std::size_t>(width));
    for (int y = begin; y != end; ++y) {
      gaussian_noise_row(noise, stream_seed(seed, Stream::class_noise, ragged_index),
                         transform.to_crs(0.0, y).y, ragged.data());
      for (int x = 0; x < width; ++x) {
        const int from_edge = std::min(std::min(x - around.part.x0, around.part.x1 - 1 - x),
                                       std::min(y - around.part.y0, around.part.y1 - 1 - y));
        const double at =
            std::clamp(static_cast<double>(from_edge) / around.collar_cells, 0.0, 1.0);
        const double strayed = at + 4.0 * at * (1.0 - at) * ragged_share *
                                        static_cast<double>(ragged[static_cast<std::size_t>(x)]);
        share(x, y) = static_cast<float>(smoothstep(strayed));
      }
    }
  });
  return share;
}

void join_input(Grid<float>& own, const Grid<float>& around, const Grid<float>& own_share,
                const GeoTransform& transform, const GeoTransform& around_transform) {
  if (own.empty() || around.empty()) return;
  parallel_rows(own.height(), [&](int y) {
    for (int x = 0; x < own.width(); ++x) {
      const float share = own_share(x, y);
      if (share >= 1.F) continue;
      const glm::dvec2 position = transform.to_crs(x, y);
      const glm::dvec2 at = around_transform.to_cell(position.x, position.y);
      const float there = sample_bilinear(around, at.x, at.y);
      own(x, y) = there + share * (own(x, y) - there);
    }
  });
}

}  // namespace belvedere
