#include "renderer/trace/water/water_ground.h"

#include <algorithm>
#include <cmath>

#include "base/filter.h"
#include "base/parallel.h"
#include "renderer/trace/guidance_ground.h"

namespace belvedere {

WaterGround::Place WaterGround::at(glm::dvec2 position_m) const {
  const glm::dvec2 seen = terrain->dem->transform.to_cell(position_m.x, position_m.y);
  const glm::dvec2 cell = origin_of(*terrain, seen.x, seen.y);
  return {sample_bilinear(beds.depth_m, cell.x, cell.y),
          sample_bilinear(beds.lake, cell.x, cell.y)};
}

std::shared_ptr<const WaterGround> find_water_ground(const TerrainModel& terrain) {
  const Raster<LandCoverClass>& classes = terrain.land_cover->classes;
  if (std::find(classes.cells.begin(), classes.cells.end(), LandCoverClass::water) ==
      classes.cells.end())
    return nullptr;
  const Dem& dem = *terrain.dem;
  Grid<std::uint8_t> water(dem.width(), dem.height(), 0);
  parallel_rows(dem.height(), [&](int y) {
    for (int x = 0; x < dem.width(); ++x) {
      const glm::dvec2 position = dem.transform.to_crs(x, y);
      const glm::dvec2 cell = classes.transform.to_cell(position.x, position.y);
      const LandCoverClass id = classes.cells.clamped(static_cast<int>(std::lround(cell.x)),
                                                      static_cast<int>(std::lround(cell.y)));
      water(x, y) = id == LandCoverClass::water ? 1 : 0;
    }
  });
  WaterGround ground;
  ground.terrain = &terrain;
  ground.beds = make_water_beds(water, dem);
  return std::make_shared<const WaterGround>(std::move(ground));
}

}  // namespace belvedere
