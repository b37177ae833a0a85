#include "base/colour/water_colour.h"

#include <glm/common.hpp>

#include "base/math_exact.h"

namespace belvedere {
namespace {

constexpr float bed_seen_m = 1.2F;   // depth at which most of the bed is lost
constexpr float turns_deep_m = 9.F;  // depth at which pale water has mostly its deep colour

}  // namespace

glm::vec3 water_colour(const glm::vec3& ground, float depth_m, const WaterColours& water) {
  if (depth_m <= 0.F) return ground;
  const auto left = [depth_m](float over_m) {
    return static_cast<float>(exact::exp(-static_cast<double>(depth_m / over_m)));
  };
  return glm::mix(glm::mix(water.deep, water.shallow, left(turns_deep_m)), ground,
                  left(bed_seen_m));
}

}  // namespace belvedere
