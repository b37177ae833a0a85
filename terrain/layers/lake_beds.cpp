#include "terrain/layers/lake_beds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/filter.h"

namespace belvedere {

Grid<float> lake_depth_m(const Dem& dem, const LakeBedParameters& parameters) {
  const int width = dem.width();
  const Grid<std::uint8_t> lakes = find_lakes(dem.altitude_m, parameters.lakes);
  Grid<std::uint8_t> land(width, dem.height());
  for (std::size_t i = 0; i < land.size(); ++i) land[i] = lakes[i] == 0 ? 1 : 0;
  const Grid<std::int32_t> nearest = nearest_marked(land);
  Grid<float> depth(width, dem.height());
  for (int y = 0; y < dem.height(); ++y)
    for (int x = 0; x < width; ++x) {
      const std::int32_t at = nearest(x, y);
      if (lakes(x, y) == 0 || at < 0) continue;
      const double dx = (at % width - x) * dem.transform.cell_x;
      const double dy = (at / width - y) * dem.transform.cell_y;
      depth(x, y) = static_cast<float>(std::sqrt(dx * dx + dy * dy));
    }
  // Lake by lake: the farthest place from the shore, then depths from distances.
  Grid<std::uint8_t> open = lakes;
  std::vector<std::size_t> lake;
  for (std::size_t first = 0; first < open.size(); ++first) {
    if (open[first] == 0) continue;
    lake.assign(1, first);
    open[first] = 0;
    float farthest = 0.F;
    for (std::size_t k = 0; k < lake.size(); ++k) {
      const int x = static_cast<int>(lake[k] % static_cast<std::size_t>(width));
      const int y = static_cast<int>(lake[k] / static_cast<std::size_t>(width));
      farthest = std::max(farthest, depth[lake[k]]);
      for (const auto& [dx, dy] : std::array<std::array<int, 2>, 4>{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}}) {
        if (!open.contains(x + dx, y + dy) || open(x + dx, y + dy) == 0) continue;
        open(x + dx, y + dy) = 0;
        lake.push_back(open.index(x + dx, y + dy));
      }
    }
    const auto deepest = static_cast<float>(std::min(parameters.deepest_m, 0.5 * parameters.shore_slope * static_cast<double>(farthest)));
    for (const std::size_t i : lake) {
      const float left = farthest > 0.F ? 1.F - depth[i] / farthest : 1.F;
      depth[i] = deepest * (1.F - left * left);
    }
  }
  return depth;
}

}  // namespace belvedere
