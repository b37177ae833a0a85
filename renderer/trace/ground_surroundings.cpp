#include "renderer/trace/ground_surroundings.h"

#include <cstdint>
#include <vector>

#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "terrain/shape/derivatives.h"

namespace belvedere {
namespace {

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

// Distance of every post to the nearest one outside.
Grid<float> rim_distance(const Dem& dem) {
  const int width = dem.width();
  const int height = dem.height();
  const Grid<std::int32_t> nearest = nearest_marked(outside(dem));
  Grid<float> distance(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const int at = nearest(x, y);
      const int across = at % width - x;
      const int down = at / width - y;
      distance(x, y) = static_cast<float>(
          exact::hypot(across * dem.transform.cell_x, down * dem.transform.cell_y));
    }
  });
  return distance;
}

// A logarithm, because areas range from a cell to a province, and a picture can distinguish a rill
// from a brook, not 500 km² from 501. Rivers that enter at the edge begin there.
Grid<float> log_upstream_area(Grid<float> area) {
  constexpr double m2_per_km2 = 1e6;
  parallel_rows(area.height(), [&](int y) {
    for (int x = 0; x < area.width(); ++x)
      area(x, y) = static_cast<float>(exact::log10(m2_per_km2 * static_cast<double>(area(x, y))));
  });
  return area;
}

}  // namespace

GroundSurroundings find_surroundings(const Dem& dem, const LandCover& land_cover,
                                     Catchments* catchments) {
  GroundSurroundings found;
  found.valley_height_m = height_above_valley(dem.altitude_m, dem.cell_m(), 900.0);
  found.rim_m = rim_distance(dem);
  Catchments own(dem);
  found.flow = log_upstream_area((catchments != nullptr ? *catchments : own).take_km2());
  found.floor_plan = plan_floor(land_cover, dem);
  return found;
}

}  // namespace belvedere
