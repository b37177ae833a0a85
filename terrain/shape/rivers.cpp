// Rivers as lines with a width: from the catchment grid, smoothed, drawn by the distance to the
// line.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "base/math_exact.h"
#include "terrain/shape/hydrology.h"
#include "terrain/shape/inferred_rivers.h"

namespace belvedere {
namespace {

constexpr double min_catchment_km2 = 75.0;    // streams begin
constexpr double full_catchment_km2 = 110.0;  // and have their full width
constexpr double full_half_width_m = 18.0;
constexpr double widest_m = 90.0;
// On coarse cells a river is widened until it is visible, .58 of a cell to each side, but by at
// most this factor.
constexpr double seen_cells = 0.58;
constexpr double widened = 30.0 / 18.0;

// The share of a cell covered by a straight river of this half-width at this distance from its
// centreline.
double cover(double distance_m, double half_width_m, double cell_m) {
  const double half_cell = 0.5 * cell_m;
  const double near = std::max(distance_m - half_cell, -half_width_m);
  const double far = std::min(distance_m + half_cell, half_width_m);
  return std::clamp((far - near) / cell_m, 0.0, 1.0);
}

// One straight piece of river; the larger cover wins where pieces overlap, so their order does not
// matter.
void draw(Grid<float>& mask, const RiverReach& from, const RiverReach& to, double cell_m) {
  const double margin = std::max(from.half_width_m, to.half_width_m) / cell_m + 1.0;
  const int x0 =
      std::max(0, static_cast<int>(std::floor(std::min(from.position.x, to.position.x) - margin)));
  const int x1 =
      std::min(mask.width() - 1,
               static_cast<int>(std::ceil(std::max(from.position.x, to.position.x) + margin)));
  const int y0 =
      std::max(0, static_cast<int>(std::floor(std::min(from.position.y, to.position.y) - margin)));
  const int y1 =
      std::min(mask.height() - 1,
               static_cast<int>(std::ceil(std::max(from.position.y, to.position.y) + margin)));
  const glm::dvec2 along = to.position - from.position;
  const double length2 = std::max(glm::dot(along, along), 1e-12);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const glm::dvec2 off = glm::dvec2(x, y) - from.position;
      const double t = std::clamp(glm::dot(off, along) / length2, 0.0, 1.0);
      const double distance_m = glm::length(off - t * along) * cell_m;
      const double half_width_m = (1.0 - t) * from.half_width_m + t * to.half_width_m;
      mask(x, y) =
          std::max(mask(x, y), static_cast<float>(cover(distance_m, half_width_m, cell_m)));
    }
  }
}

}  // namespace

double river_half_width_m(double catchment_km2) {
  if (catchment_km2 <= min_catchment_km2) return 0.0;
  const double exponent = exact::log(60.0 / 30.0) / exact::log(500.0 / 110.0);
  const double t = std::clamp(
      (catchment_km2 - min_catchment_km2) / (full_catchment_km2 - min_catchment_km2), 0.0, 1.0);
  return std::min(widest_m, full_half_width_m *
                                exact::pow(catchment_km2 / full_catchment_km2, exponent) * t * t *
                                (3.0 - 2.0 * t));
}

Grid<float> river_mask(const Grid<float>& catchment_km2, double cell_m) {
  std::vector<RiverReach> reaches = find_reaches(catchment_km2, min_catchment_km2);
  for (RiverReach& reach : reaches) {
    const double own_m = river_half_width_m(static_cast<double>(reach.catchment_km2));
    reach.half_width_m = std::max(own_m, std::min(widened * own_m, seen_cells * cell_m));
  }
  smooth_reaches(reaches);
  Grid<float> mask(catchment_km2.width(), catchment_km2.height());
  for (const RiverReach& reach : reaches) {
    if (reach.downstream != no_reach) draw(mask, reach, reaches[reach.downstream], cell_m);
  }
  return mask;
}

}  // namespace belvedere
