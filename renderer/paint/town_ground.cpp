#include "renderer/paint/town_ground.h"

#include <glm/common.hpp>

#include "base/math.h"
#include "texture/strokes/parcels.h"

namespace belvedere {
namespace {

constexpr float garden_share = 0.80F;           // share in a village: houses stand in greenery …
constexpr float town_garden_share = 0.30F;      // … and in the centre of a town
constexpr glm::vec3 pale{0.74F, 0.70F, 0.60F};  // yards, walls and lanes in full light
constexpr float pale_share = 0.35F;
constexpr float pale_from = 0.02F;  // density of houses from which the ground is pale …
constexpr float pale_to = 0.18F;    // … and fully so

}  // namespace

glm::vec3 town_ground_colour(const Palette& palette, glm::vec3 street, float built,
                             double altitude_m, double light, float drift, float metres_per_unit) {
  const float green = garden_share + (town_garden_share - garden_share) * unit(built);
  const glm::vec3 lawn =
      palette.winter ? glm::vec3(1.0F) : 1.0F + (crop_colour(Crop::grass) - 1.0F) * drift;
  const LandCoverClass gardens =
      palette.winter ? LandCoverClass::snow : LandCoverClass::valley_floor;
  const glm::vec3 ground =
      glm::mix(street, lawn * palette_colour(palette, gardens, altitude_m, light - 0.08), green);
  if (palette.winter) return ground;
  const float place = village_share(metres_per_unit) * smoothstep(pale_from, pale_to, built);
  return glm::mix(ground, pale * (0.55F + 0.60F * static_cast<float>(light)), pale_share * place);
}

}  // namespace belvedere
