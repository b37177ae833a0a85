#pragma once

#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "renderer/paint/ground/ground_tint.h"

namespace belvedere {

// Varied greens: a meadow is lush where water gathers, pale where the sun dries it, brown-olive
// high above the trees, and mown in strips where people live. Relief decides and, for large patches
// only, noise: hues change over a slope, not over a stroke.

// Relief around a piece of grass.
struct MeadowPosition {
  float slope_deg = 0.0F;
  float sunny = 0.0F;       // -1 steep and facing away from the noon sun … 1 steep and facing it
  float relief_s_m = 0.0F;  // height above the mean of the ground around: small forms …
  float relief_m_m = 0.0F;  // … and middle ones
  float valley_height_m = 0.0F;   // above the lowest ground nearby
  float above_treeline_m = 0.0F;  // < 0 below it
};

// Shares of the kinds of meadow, 0…1 each; the rest is meadow in the palette's colour.
struct MeadowMix {
  float lush = 0.0F;
  float dry = 0.0F;
  float high = 0.0F;  // short turf of high ground
  float mown = 0.0F;  // hay parcels
};

// `sunny_side`: 1 where the noon sun stands in the south, -1 in the north.
MeadowPosition meadow_position(const GuidanceBuffers& guidance, std::size_t i, double treeline_m,
                               float sunny_side);
// Zero for classes other than grass.
MeadowMix meadow_mix(LandCoverClass id, const MeadowPosition& position, const Patches& patches);
// Factor of the colour, encoded sRGB. strength 0…3: AirParameters::hue_drift times the palette's
// share.
glm::vec3 meadow_hue(const MeadowMix& mix, float strength);

// How relief changes a wood: trees in gullies stand close, dark and blue; on ribs and shoulders
// they are lighter and warmer. Light alone shows this weakly, because crowns hide the ground.
struct ForestTurn {
  float tone = 0.0F;       // added to the light
  glm::vec3 factor{1.0F};  // of the colour, encoded sRGB
};
// relief_s_m and relief_m_m: height above the mean of the ground around, small and middle forms.
// light: the tone, 0…1; shade is not darkened further, because a wood would lose its forms there.
// strength: as hue_drift, 0…3.
ForestTurn forest_turn(float relief_s_m, float relief_m_m, float light, const Patches& patches,
                       float strength);

}  // namespace belvedere
