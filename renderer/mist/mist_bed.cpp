#include "renderer/mist/mist_bed.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/filter.h"
#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr double cell_m = 120.0;  // of the wide cells, approximately
constexpr double floor_reach_m =
    700.0;  // a floor is the lowest ground within this distance, continued under the slopes …
constexpr double floor_sigma_m = 450.0;    // … and smoothed
constexpr double around_sigma_m = 5000.0;  // surroundings that a floor lies below
constexpr double broad_m = 2600.0;         // deviation of the noise that forms banks …
constexpr double narrow_m = 700.0;         // … and that frays them
constexpr double sea_hollow_m = 170.0;     // how far the surface of a torn sea sinks
constexpr std::uint64_t narrow_part = 1;

// Blocks of `times` cells in each direction: their lowest value, or their mean.
template <class Join>
Grid<float> join_blocks(const Grid<float>& values, int times, float begin, Join&& join, bool mean) {
  Grid<float> out((values.width() + times - 1) / times, (values.height() + times - 1) / times);
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      float sum = begin;
      int count = 0;
      for (int v = y * times; v < std::min(values.height(), (y + 1) * times); ++v)
        for (int u = x * times; u < std::min(values.width(), (x + 1) * times); ++u, ++count)
          sum = join(sum, values(u, v));
      out(x, y) = mean ? sum / static_cast<float>(count) : sum;
    }
  });
  return out;
}
Grid<float> lowest_of(const Grid<float>& values, int times) {
  return join_blocks(
      values, times, std::numeric_limits<float>::max(),
      [](float a, float b) { return std::min(a, b); }, false);
}
Grid<float> mean_of(const Grid<float>& values, int times) {
  return join_blocks(
      values, times, 0.0F, [](float a, float b) { return a + b; }, true);
}

double value_at(const Grid<float>& grid, const GeoTransform& transform, glm::dvec2 position) {
  const glm::dvec2 cell = transform.to_cell(position.x, position.y);
  return sample_bilinear(grid, std::clamp(cell.x, 0.0, grid.width() - 1.0),
                         std::clamp(cell.y, 0.0, grid.height() - 1.0));
}

// 0…1: flat, and lower than the surroundings.
Grid<float> find_level(const Grid<float>& floor_m, const Grid<float>& around_m, double wide_m) {
  Grid<float> level(floor_m.width(), floor_m.height());
  parallel_rows(level.height(), [&](int y) {
    for (int x = 0; x < level.width(); ++x) {
      const float east = floor_m.clamped(x + 1, y) - floor_m.clamped(x - 1, y);
      const float south = floor_m.clamped(x, y + 1) - floor_m.clamped(x, y - 1);
      const float rise = std::sqrt(east * east + south * south) / static_cast<float>(2.0 * wide_m);
      const float below = around_m(x, y) - floor_m(x, y);
      level(x, y) = (1.0F - smoothstep(0.05F, 0.17F, rise)) * smoothstep(-60.0F, 140.0F, below);
    }
  });
  return level;
}

}  // namespace

double MistGround::floor_at(glm::dvec2 position) const {
  return value_at(floor_m, transform, position);
}
double MistGround::level_at(glm::dvec2 position) const {
  return value_at(level, transform, position);
}
double MistGround::rim_at(glm::dvec2 position) const {
  return value_at(rim_m, transform, position);
}

MistGround make_mist_ground(const Grid<float>& altitude_m, const Grid<float>& rim_m,
                            const GeoTransform& transform, bool floors) {
  const int times = std::max(1, static_cast<int>(std::lround(cell_m / transform.cell_x)));
  MistGround ground;
  ground.transform = {transform.origin_x, transform.origin_y, transform.cell_x * times,
                      transform.cell_y * times};
  ground.rim_m = mean_of(rim_m, times);
  if (!floors) return ground;
  const double wide_m = ground.transform.cell_x;
  const Grid<float> lowest = lowest_of(altitude_m, times);
  ground.floor_m = gaussian_blur(
      window_minimum(lowest, std::max(1, static_cast<int>(std::lround(floor_reach_m / wide_m)))),
      floor_sigma_m / wide_m);
  ground.level = find_level(
      ground.floor_m, gaussian_blur(mean_of(altitude_m, times), around_sigma_m / wide_m), wide_m);
  return ground;
}

MistBed::MistBed(const MistParameters& parameters, const MistGround& ground, double rim_fade_m,
                 std::uint64_t seed)
    : parameters_(parameters),
      ground_(ground),
      rim_fade_m_(rim_fade_m),
      highest_m_(parameters.to_m),
      broad_(stream_seed(seed, Stream::mist_patches), broad_m),
      narrow_(stream_seed(seed, Stream::mist_patches, narrow_part), narrow_m) {
  if (parameters.kind != MistKind::valley) return;
  highest_m_ = -std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < ground.floor_m.size(); ++i)
    if (ground.level[i] > 0.0F)
      highest_m_ =
          std::max(highest_m_, static_cast<double>(ground.floor_m[i]) + parameters.height_m);
}

MistBed::Column MistBed::at(glm::dvec2 position) {
  const MistParameters& p = parameters_;
  Column column{p.to_m, 1.0};
  if (rim_fade_m_ > 0.0) column.cover *= smoothstep(0.0, rim_fade_m_, ground_.rim_at(position));
  if (p.position && p.radius_m > 0.0) {
    const glm::dvec2 from = position - *p.position;
    column.cover *= 1.0 - smoothstep(0.75 * p.radius_m, p.radius_m,
                                     std::sqrt(from.x * from.x + from.y * from.y));
  }
  if (column.cover <= 0.0 && p.kind == MistKind::sea) return column;
  // Above 0 in banks, below in gaps.
  const double bank = p.patches > 0.0
                          ? 0.8 * broad_(position.x, position.y) +
                                0.45 * narrow_(position.x, position.y) + 1.9 - 3.0 * p.patches
                          : 1.0;
  if (p.kind == MistKind::sea) {
    column.top_m -= sea_hollow_m * p.patches * std::max(0.0, 1.0 - bank);
    column.cover *= smoothstep(-0.7, 0.5, bank);
    return column;
  }
  const double full = smoothstep(-0.5, 0.9, bank);
  column.top_m = ground_.floor_at(position) + p.height_m * (0.25 + 0.75 * full);
  column.cover *= ground_.level_at(position) * full;
  return column;
}

}  // namespace belvedere
