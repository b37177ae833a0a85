#pragma once

#include <glm/vec3.hpp>

#include "renderer/paint/ground_hues.h"

namespace belvedere {

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
