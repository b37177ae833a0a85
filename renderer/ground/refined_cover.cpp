#include "renderer/ground/refined_cover.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace belvedere {
namespace {

LandCoverClass nearest_class(const LandCover& cover, glm::dvec2 position) {
  const glm::dvec2 at = cover.classes.transform.to_cell(position.x, position.y);
  return cover.classes.cells.clamped(static_cast<int>(std::lround(at.x)),
                                     static_cast<int>(std::lround(at.y)));
}

}  // namespace

void refine_by_rules(LandCover& cover, const LandCover& rules, const CoverRefinement& refine) {
  Grid<LandCoverClass>& cells = cover.classes.cells;
  parallel_rows(cells.height(), [&](int y) {
    for (int x = 0; x < cells.width(); ++x) {
      const LandCoverClass seen = nearest_class(rules, cover.classes.transform.to_crs(x, y));
      for (const auto& [to, from] : refine)
        if (cells(x, y) == from && seen == to) {
          cells(x, y) = to;
          break;
        }
    }
  });
}

std::vector<CoverRiver> refine_rivers(std::vector<CoverRiver> rivers, const LandCover& cover,
                                      const CoverRefinement& refine) {
  const auto to_water = [](const auto& row) { return row.first == LandCoverClass::water; };
  if (std::none_of(refine.begin(), refine.end(), to_water)) return {};
  for (CoverRiver& river : rivers)
    for (std::size_t i = 0; i < river.positions.size(); ++i) {
      const LandCoverClass here = nearest_class(cover, river.positions[i]);
      const auto allows = [&](const auto& row) { return to_water(row) && row.second == here; };
      if (here != LandCoverClass::water && std::none_of(refine.begin(), refine.end(), allows))
        river.half_width_m[i] = 0.F;
    }
  return rivers;
}

}  // namespace belvedere
