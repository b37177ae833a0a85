#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "renderer/paint/picture_noise.h"

namespace belvedere {

// Where wind ruffles a lake: patches on the ground that do not move with the view. Use one per
// thread.
struct WaterWind {
  explicit WaterWind(std::uint64_t seed);
  // 0 smooth … 1 ruffled, at a position with so many metres of ground in a unit of the sheet; forms
  // smaller than a stroke are left out. `strength` is WaterParameters::wind.
  float ruffled(glm::dvec3 position_m, float metres_per_unit, float strength);

 private:
  GroundNoise broad_, fine_;
};

}  // namespace belvedere
