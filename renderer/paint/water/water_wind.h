#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "renderer/paint/picture_noise.h"

namespace belvedere {

// Where wind ruffles a lake: patches on the ground, which keep their place on the water whatever the view. One for each thread.
struct WaterWind {
  explicit WaterWind(std::uint64_t seed);
  // 0 smooth … 1 ruffled, at a place of which a unit of the sheet shows so many metres: what is smaller than a stroke is left out.
  // `strength` is WaterParameters::wind.
  float ruffled(glm::dvec3 place_m, float metres_per_unit, float strength);

 private:
  GroundNoise broad_, fine_;
};

}  // namespace belvedere
