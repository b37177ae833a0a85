#pragma once

#include <glm/vec2.hpp>
#include <memory>

#include "renderer/trace/terrain_model.h"
#include "terrain/shape/water_beds.h"

namespace belvedere {

// What lies below the water of a terrain: beds made up from its banks, and which water is a lake.
struct WaterGround {
  const TerrainModel* terrain = nullptr;
  WaterBeds beds;  // on the terrain's cells

  struct Place {
    float depth_m = 0.0F;
    float lake = 0.0F;  // 1 lake or sea … 0 river
  };
  // At a place of the scene's CRS, which is one of the ground as it is seen: what widened valleys have moved comes from where it was.
  Place at(glm::dvec2 place_m) const;
};

// Null where the terrain has no water. The terrain must outlive it. Of a terrain with finer windows the beds are those of its coarse cells.
std::shared_ptr<const WaterGround> find_water_ground(const TerrainModel& terrain);

}  // namespace belvedere
