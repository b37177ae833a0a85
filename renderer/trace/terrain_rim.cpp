#include "renderer/trace/terrain_rim.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

// Ground rises above the region from so many standard deviations above its mean altitude; each
// further one lifts it by this share of the region's shorter side. The default fade is about .03 of
// the side, so that a summit at four deviations keeps its own colour even at the edge.
constexpr double tall_deviations = 2.5;
constexpr double lift_of_side = 0.02;
constexpr double max_lift_of_side =
    0.03;  // such a body has lost nothing: more would only reach farther
// m of lift lost per m of ground. Below 1 ground straight before a mountain is never nearer to the
// end than the mountain; .5 allows lines of sight 60° off that direction.
constexpr double lift_slope = 0.5;

// 1 where the known terrain ends: the border's own posts and the filled voids that reach the
// border. A filled void inside known terrain is not an edge.
Grid<std::uint8_t> outside(const Dem& dem) {
  const int width = dem.width();
  const int height = dem.height();
  Grid<std::uint8_t> out(width, height, 0);
  std::vector<glm::ivec2> open;
  const auto mark = [&](int x, int y) {
    if (!out.contains(x, y) || out(x, y) != 0) return;
    out(x, y) = 1;
    open.emplace_back(x, y);
  };
  for (int x = 0; x < width; ++x) mark(x, 0), mark(x, height - 1);
  for (int y = 0; y < height; ++y) mark(0, y), mark(width - 1, y);
  if (dem.filled.empty()) return out;
  while (!open.empty()) {
    const glm::ivec2 at = open.back();
    open.pop_back();
    for (const glm::ivec2 step :
         {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
      const glm::ivec2 next = at + step;
      if (dem.filled.contains(next.x, next.y) && dem.filled(next.x, next.y) != 0)
        mark(next.x, next.y);
    }
  }
  return out;
}

// Every post of a grid raised to the cones that fall from all others by so much a column, a row and
// a diagonal. Two passes over the grid.
void raise_to_cones(Grid<float>& grid, float column, float row, float diagonal) {
  const int width = grid.width();
  const int height = grid.height();
  const auto pass = [&](int step) {
    for (int k = 0; k < height; ++k) {
      const int y = step > 0 ? k : height - 1 - k;
      const bool has_row = k > 0;
      for (int j = 0; j < width; ++j) {
        const int x = step > 0 ? j : width - 1 - j;
        float best = grid(x, y);
        if (j > 0) best = std::max(best, grid(x - step, y) - column);
        if (has_row) {
          best = std::max(best, grid(x, y - step) - row);
          if (x > 0) best = std::max(best, grid(x - 1, y - step) - diagonal);
          if (x < width - 1) best = std::max(best, grid(x + 1, y - step) - diagonal);
        }
        grid(x, y) = best;
      }
    }
  };
  pass(1);
  pass(-1);
}

// The lift of mountains far above the region, 0 elsewhere.
Grid<float> lift_of_mountains(const Dem& dem, const Grid<std::uint8_t>& beyond) {
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < beyond.size(); ++i) {
    if (beyond[i] != 0) continue;
    const auto altitude = static_cast<double>(dem.altitude_m[i]);
    count += 1.0;
    sum += altitude;
    squares += altitude * altitude;
  }
  Grid<float> lift(dem.width(), dem.height(), 0.0F);
  if (count == 0.0) return lift;
  const double mean = sum / count;
  const double deviation = std::sqrt(std::max(0.0, squares / count - mean * mean));
  if (deviation <= 0.0) return lift;
  const double cell_x = std::abs(dem.transform.cell_x);
  const double cell_y = std::abs(dem.transform.cell_y);
  const double side_m = std::min(dem.width() * cell_x, dem.height() * cell_y);
  bool any = false;
  for (std::size_t i = 0; i < lift.size(); ++i) {
    const double above =
        (static_cast<double>(dem.altitude_m[i]) - mean) / deviation - tall_deviations;
    if (above <= 0.0 || beyond[i] != 0) continue;
    lift[i] = static_cast<float>(side_m * std::min(lift_of_side * above, max_lift_of_side));
    any = true;
  }
  if (any)
    raise_to_cones(lift, static_cast<float>(lift_slope * cell_x),
                   static_cast<float>(lift_slope * cell_y),
                   static_cast<float>(lift_slope * exact::hypot(cell_x, cell_y)));
  return lift;
}

}  // namespace

Grid<float> rim_distance(const Dem& dem) {
  const int width = dem.width();
  const int height = dem.height();
  const Grid<std::uint8_t> beyond = outside(dem);
  const Grid<std::int32_t> nearest = nearest_marked(beyond);
  const Grid<float> lift = lift_of_mountains(dem, beyond);
  Grid<float> distance(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const int at = nearest(x, y);
      const int across = at % width - x;
      const int down = at / width - y;
      distance(x, y) = static_cast<float>(exact::hypot(across * dem.transform.cell_x,
                                                       down * dem.transform.cell_y)) +
                       lift(x, y);
    }
  });
  return distance;
}

}  // namespace belvedere
