#include "renderer/ground/refined_cover.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace belvedere {

void refine_by_rules(LandCover& cover, const LandCover& rules, const CoverRefinement& refine) {
  Grid<LandCoverClass>& cells = cover.classes.cells;
  parallel_rows(cells.height(), [&](int y) {
    for (int x = 0; x < cells.width(); ++x) {
      const glm::dvec2 place = cover.classes.transform.to_crs(x, y);
      const glm::dvec2 at = rules.classes.transform.to_cell(place.x, place.y);
      const LandCoverClass seen = rules.classes.cells.clamped(static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)));
      for (const auto& [to, from] : refine)
        if (cells(x, y) == from && seen == to) {
          cells(x, y) = to;
          break;
        }
    }
  });
}

std::vector<CoverCourse> refine_rivers(std::vector<CoverCourse> rivers, const LandCover& cover, const CoverRefinement& refine) {
  const auto to_water = [](const auto& row) { return row.first == LandCoverClass::water; };
  if (std::none_of(refine.begin(), refine.end(), to_water)) return {};
  const Grid<LandCoverClass>& cells = cover.classes.cells;
  for (CoverCourse& river : rivers)
    for (std::size_t i = 0; i < river.places.size(); ++i) {
      const glm::dvec2 at = cover.classes.transform.to_cell(river.places[i].x, river.places[i].y);
      const LandCoverClass here = cells.clamped(static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)));
      const auto allows = [&](const auto& row) { return to_water(row) && row.second == here; };
      if (here != LandCoverClass::water && std::none_of(refine.begin(), refine.end(), allows)) river.half_width_m[i] = 0.F;
    }
  return rivers;
}

}  // namespace belvedere
