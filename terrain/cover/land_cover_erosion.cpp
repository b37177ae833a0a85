#include "terrain/cover/land_cover_erosion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/masks/erosion.h"

namespace belvedere {

LandCover erode_land_cover(LandCover cover, const CoverErosion& erosion, std::uint64_t seed) {
  if (erosion.empty()) return cover;
  Grid<LandCoverClass>& cells = cover.classes.cells;
  const GeoTransform& position = cover.classes.transform;
  Grid<std::uint8_t> labels(cells.width(), cells.height());
  std::transform(cells.begin(), cells.end(), labels.begin(),
                 [](LandCoverClass id) { return static_cast<std::uint8_t>(id); });
  std::array<bool, 256> opens{};
  for (const LandCoverClassInfo& info : land_cover_classes())
    opens[static_cast<std::size_t>(info.id)] = info.id != LandCoverClass::sky &&
                                               info.id != LandCoverClass::water &&
                                               info.id != LandCoverClass::settlement;
  ErosionParameters parameters;
  parameters.cell = std::sqrt(std::abs(position.cell_x * position.cell_y));
  parameters.step = std::max(cover_erosion_step_m, .5 * parameters.cell);
  parameters.seed = seed;
  parameters.x = position.origin_x + .5 * position.cell_x;
  parameters.y = position.origin_y - .5 * position.cell_y;
  parameters.dx = position.cell_x;
  parameters.dy = -position.cell_y;
  for (const auto& [id, steps] : erosion) {
    if (steps < 1) continue;
    parameters.levels = steps;
    labels = erode(labels, static_cast<std::uint8_t>(id), opens, parameters).labels;
  }
  std::transform(labels.begin(), labels.end(), cells.begin(),
                 [](std::uint8_t label) { return static_cast<LandCoverClass>(label); });
  return cover;
}

}  // namespace belvedere
