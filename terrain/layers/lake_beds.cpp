#include "terrain/layers/lake_beds.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/filter.h"
#include "terrain/shape/mask_pieces.h"

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
  // For each lake: the maximum distance from the shore, then depths from distances.
  each_piece(lakes, 1, [&](const std::vector<std::int32_t>& lake) {
    float farthest = 0.F;
    for (const std::int32_t i : lake)
      farthest = std::max(farthest, depth[static_cast<std::size_t>(i)]);
    const auto deepest = static_cast<float>(std::min(
        parameters.deepest_m, 0.5 * parameters.shore_slope * static_cast<double>(farthest)));
    for (const std::int32_t i : lake) {
      float& at = depth[static_cast<std::size_t>(i)];
      const float left = farthest > 0.F ? 1.F - at / farthest : 1.F;
      at = deepest * (1.F - left * left);
    }
  });
  return depth;
}

}  // namespace belvedere
