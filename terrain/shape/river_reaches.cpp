// Cells of rivers, linked along the drainage.

#include "terrain/shape/river_reaches.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace belvedere {
namespace {

// Passes of [1 2 1] / 4, each of variance 1/2: 24 smooth by sqrt(12) = 3.5 cells.
constexpr int smoothing_passes = 24;

}  // namespace

std::vector<RiverReach> find_reaches(const Grid<float>& catchment_km2, double min_km2) {
  std::vector<RiverReach> reaches;
  Grid<std::int32_t> number(catchment_km2.width(), catchment_km2.height(), -1);
  for (int y = 0; y < catchment_km2.height(); ++y) {
    for (int x = 0; x < catchment_km2.width(); ++x) {
      const float area = catchment_km2(x, y);
      if (static_cast<double>(area) < min_km2) continue;
      number(x, y) = static_cast<std::int32_t>(reaches.size());
      reaches.push_back({{x, y}, 0.0, area, no_reach, no_reach});
    }
  }
  for (std::size_t i = 0; i < reaches.size(); ++i) {
    RiverReach& reach = reaches[i];
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = static_cast<int>(reach.position.x) + dx;
        const int y = static_cast<int>(reach.position.y) + dy;
        if (!number.contains(x, y) || number(x, y) < 0) continue;
        const auto other = static_cast<std::size_t>(number(x, y));
        if (reaches[other].catchment_km2 <= reach.catchment_km2) continue;
        if (reach.downstream == no_reach ||
            reaches[other].catchment_km2 < reaches[reach.downstream].catchment_km2)
          reach.downstream = other;
      }
    }
    if (reach.downstream == no_reach) continue;
    RiverReach& below = reaches[reach.downstream];
    if (below.upstream == no_reach || reaches[below.upstream].catchment_km2 < reach.catchment_km2)
      below.upstream = i;
  }
  return reaches;
}

void smooth_reaches(std::vector<RiverReach>& reaches) {
  for (int pass = 0; pass < smoothing_passes; ++pass) {
    std::vector<RiverReach> next = reaches;
    for (std::size_t i = 0; i < reaches.size(); ++i) {
      const RiverReach& here = reaches[i];
      if (here.upstream == no_reach || here.downstream == no_reach) continue;
      const RiverReach& above = reaches[here.upstream];
      const RiverReach& below = reaches[here.downstream];
      next[i].position = 0.5 * here.position + 0.25 * (above.position + below.position);
      next[i].half_width_m =
          0.5 * here.half_width_m + 0.25 * (above.half_width_m + below.half_width_m);
    }
    reaches.swap(next);
  }
}

}  // namespace belvedere
