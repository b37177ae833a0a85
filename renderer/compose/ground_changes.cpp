#include "renderer/compose/ground_changes.h"

#include <limits>
#include <utility>

#include "base/parallel.h"
#include "base/progress.h"
#include "terrain/generalize/widen_valleys.h"

namespace belvedere {

CoarseGround widened_ground(const CoarseGround& ground, double width_m) {
  Grid<float> altitude(ground.cells.width(), ground.cells.height());
  Grid<std::uint8_t> lakes(altitude.width(), altitude.height(), 0);
  for (std::size_t i = 0; i < altitude.size(); ++i) {
    altitude[i] = ground.cells[i].altitude_m;
    lakes[i] = ground.cells[i].water ? 1 : 0;
  }
  WidenValleysParameters parameters;
  parameters.width_m = static_cast<float>(width_m);
  Raster<float> raster{
      widen_valleys(altitude, lakes, {}, ground.cell_m, parameters, silent_progress()).altitude_m,
      ground.transform, ground.crs};
  for (std::size_t i = 0; i < altitude.size(); ++i)
    if (!ground.cells[i].known) raster.cells[i] = std::numeric_limits<float>::quiet_NaN();
  CoarseGround out = make_coarse_ground(std::move(raster), ground.source_cell_m);
  for (std::size_t i = 0; i < altitude.size(); ++i) {
    out.cells[i].water = ground.cells[i].water;
    out.cells[i].rim_m = ground.cells[i].rim_m;
  }
  out.side_m = ground.side_m;
  out.void_share = ground.void_share;
  out.low_m = ground.low_m;
  out.upper_m = ground.upper_m;
  out.relief_m = ground.relief_m;
  out.plateau = ground.plateau;
  return out;
}

CoarseGround raised_ground(const CoarseGround& ground,
                           const std::vector<SummitExaggeration>& summits) {
  DeformParameters change;
  change.summits = summits;
  const Deformation deformation(change, {0.0, 0.0});
  CoarseGround out = ground;
  parallel_rows(out.cells.height(), [&](int y) {
    for (int x = 0; x < out.cells.width(); ++x) {
      GroundCell& cell = out.cells(x, y);
      const auto before = static_cast<double>(cell.altitude_m);
      const double rise = deformation.rearranged({out.transform.to_crs(x, y), before}).z - before;
      cell.altitude_m = static_cast<float>(before + rise);
      cell.above_m = static_cast<float>(static_cast<double>(cell.above_m) + rise);
    }
  });
  return out;
}

}  // namespace belvedere
