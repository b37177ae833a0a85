#include "renderer/paint/ground/meadow_hues.h"

#include <algorithm>
#include <glm/common.hpp>

#include "base/math.h"

namespace belvedere {
namespace {

using Class = LandCoverClass;

// Factors on the ramps of grass (encoded sRGB), which are a warm yellow-green.
constexpr glm::vec3 lush_hue{0.82F, 0.95F, 0.79F};
constexpr glm::vec3 dry_hue{1.06F, 0.99F, 0.93F};
constexpr glm::vec3 high_hue{0.935F, 0.915F, 0.81F};

constexpr float sunny_gain =
    2.0F;  // a slope of 30° on the smoothed, exaggerated ground counts fully

// How strongly moisture and dryness affect a class: fields have their own hues, heath is always
// dry.
float reach(Class id) {
  if (id == Class::shrub) return 0.55F;
  if (has_trait(id, ClassTrait::bleaches)) return 1.0F;
  return id == Class::valley_floor ? 0.7F : 0.0F;
}

}  // namespace

MeadowPosition meadow_position(const GuidanceBuffers& g, std::size_t i, double treeline_m,
                               float sunny_side) {
  MeadowPosition position;
  position.slope_deg = g.slope_deg[i];
  position.sunny = std::clamp(-sunny_gain * sunny_side * g.normal_smooth[i].y, -1.0F, 1.0F);
  position.relief_s_m = g.relief_s_m[i];
  position.relief_m_m = g.relief_m_m[i];
  position.valley_height_m = g.valley_height_m[i];
  position.above_treeline_m = g.altitude_m[i] - static_cast<float>(treeline_m);
  return position;
}

MeadowMix meadow_mix(Class id, const MeadowPosition& position, const Patches& patches) {
  const float reached = reach(id);
  if (!(reached > 0.0F)) return {};
  // Hollows and the feet of slopes are wet, shoulders and ridges dry; noise shifts whole patches of
  // some hundred metres. A valley floor is all hollow: only small forms count there.
  const float broad =
      id == Class::valley_floor ? 0.0F : std::clamp(position.relief_m_m / 40.0F, -1.0F, 1.0F);
  const float hollow = -0.45F * broad - 0.30F * std::clamp(position.relief_s_m / 9.0F, -1.0F, 1.0F);
  const float chance = 0.24F * patches.n25 + 0.20F * patches.n60 + 0.10F * patches.n8;
  const float moisture = hollow - 0.55F * position.sunny + chance;
  const float turf = smoothstep(
      -150.0F, 450.0F, position.above_treeline_m + 110.0F * patches.n25 + 60.0F * patches.n8);
  MeadowMix mix;
  mix.lush = reached * smoothstep(0.02F, 0.70F, moisture) * (1.0F - 0.25F * turf);
  mix.dry = reached * smoothstep(0.02F, 0.75F, -moisture) * (1.0F - 0.45F * turf);
  if (id == Class::alpine_grass || id == Class::pasture) mix.high = turf;
  if (id == Class::pasture)
    mix.mown = (1.0F - smoothstep(9.0F, 17.0F, position.slope_deg)) *
               (1.0F - smoothstep(70.0F, 170.0F, position.valley_height_m + 35.0F * patches.n25)) *
               (1.0F - smoothstep(-650.0F, -350.0F, position.above_treeline_m));
  return mix;
}

glm::vec3 meadow_hue(const MeadowMix& mix, float strength) {
  glm::vec3 factor = glm::mix(glm::vec3(1.0F), high_hue, mix.high);
  factor *= glm::mix(glm::vec3(1.0F), lush_hue, mix.lush);
  factor *= glm::mix(glm::vec3(1.0F), dry_hue, mix.dry);
  return glm::max(1.0F + (factor - 1.0F) * strength, glm::vec3(0.3F));
}

ForestTurn forest_turn(float relief_s_m, float relief_m_m, float light, const Patches& patches,
                       float strength) {
  const float centre = std::clamp(relief_m_m / 45.0F, -1.0F, 1.0F);
  const float small = std::clamp(relief_s_m / 9.0F, -1.0F, 1.0F);
  const float rib = std::clamp(0.60F * centre + 0.45F * small + 0.12F * patches.n25, -1.0F, 1.0F);
  ForestTurn turn;
  turn.tone = 0.11F * rib * strength *
              (rib < 0.0F ? 0.15F + 0.85F * smoothstep(0.08F, 0.45F, light) : 1.0F);
  const glm::vec3 hue =
      rib > 0.0F ? glm::vec3(0.055F, 0.030F, -0.055F) : glm::vec3(0.09F, 0.05F, -0.03F);
  turn.factor = 1.0F + hue * (rib * strength);
  return turn;
}

}  // namespace belvedere
