#pragma once

#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "renderer/paint/ground_hues.h"

namespace belvedere {

// Many greens: a meadow is lush where water gathers, pale where the sun dries it, brown-olive high above the trees, and mown in strips
// where people live. What decides is the lie of the land and, for large patches alone, chance: hues change over a slope, not over a stroke.

// Where a piece of grass lies.
struct MeadowPlace {
  float slope_deg = 0.0F;
  float sunny = 0.0F;             // -1 steep and turned away from the noon sun … 1 steep and turned to it
  float relief_s_m = 0.0F;        // height above the mean of the ground around: small forms …
  float relief_m_m = 0.0F;        // … and middle ones
  float valley_height_m = 0.0F;   // above the lowest ground near by
  float above_treeline_m = 0.0F;  // < 0 below it
};

// Shares of what a meadow is, 0…1 each; what is left is meadow as the palette has it.
struct MeadowMix {
  float lush = 0.0F;
  float dry = 0.0F;
  float high = 0.0F;  // short turf of the heights
  float mown = 0.0F;  // parcels of hay
};

// `sunny_side`: 1 where the noon sun stands in the south, -1 in the north.
MeadowPlace meadow_place(const GuidanceBuffers& guidance, std::size_t i, double treeline_m, float sunny_side);
// Nothing for classes that are no grass.
MeadowMix meadow_mix(LandCoverClass id, const MeadowPlace& place, const Patches& patches);
// Factor of the colour, encoded sRGB. strength 0…3: AirParameters::hue_drift times the palette's share.
glm::vec3 meadow_hue(const MeadowMix& mix, float strength);

}  // namespace belvedere
