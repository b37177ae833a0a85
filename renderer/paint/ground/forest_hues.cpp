#include "renderer/paint/ground/forest_hues.h"

#include <algorithm>
#include <glm/common.hpp>

#include "base/math.h"

namespace belvedere {

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
