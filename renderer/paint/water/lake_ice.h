#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "renderer/paint/palette.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {

// Ice of lakes: pale blue grey, snow drifts, few cracks, and a darker line of wet ice along the
// shore. Use one per thread.
struct LakeIce {
  explicit LakeIce(std::uint64_t seed);
  // Encoded sRGB at a light, of ice over water of that depth; `metres_per_unit` as elsewhere.
  glm::vec3 colour(const Palette& palette, double altitude_m, double light, glm::dvec3 position_m,
                   float depth_m, float metres_per_unit);

 private:
  GroundNoise drifts_, small_drifts_, cracks_, stretches_;
};

// Whether a lake at an altitude is frozen.
inline bool is_frozen(const Palette& palette, double altitude_m) {
  return palette.winter && altitude_m >= palette.lakes_freeze_from_m;
}

}  // namespace belvedere
