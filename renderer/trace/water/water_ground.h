#pragma once

#include <glm/vec2.hpp>
#include <memory>

#include "renderer/trace/terrain_model.h"
#include "terrain/shape/water_beds.h"

namespace belvedere {

// The ground below a terrain's water: beds inferred from the banks, and which water is a lake.
struct WaterGround {
  const TerrainModel* terrain = nullptr;
  WaterBeds beds;  // on the terrain's cells

  struct Place {
    float depth_m = 0.0F;
    float lake = 0.0F;  // 1 lake or sea … 0 river
  };
  // At a position in the scene's CRS on the ground as drawn: content moved by widened valleys is
  // read at its origin.
  Place at(glm::dvec2 position_m) const;
};

// Null if the terrain has no water. The terrain must outlive it. For a terrain with finer windows
// the beds are those of its coarse cells.
std::shared_ptr<const WaterGround> find_water_ground(const TerrainModel& terrain);

}  // namespace belvedere
