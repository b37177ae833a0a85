#include "renderer/paint/town_ground.h"

#include <glm/common.hpp>

#include "base/math.h"
#include "texture/strokes/parcels.h"

namespace belvedere {
namespace {

constexpr float garden_share = 0.80F;       // share in a village: houses stand in greenery …
constexpr float town_garden_share = 0.30F;  // … and in the centre of a town

}  // namespace

glm::vec3 town_ground_colour(const Palette& palette, glm::vec3 street, float built,
                             double altitude_m, double light, float drift) {
  const float green = garden_share + (town_garden_share - garden_share) * unit(built);
  const glm::vec3 lawn =
      palette.winter ? glm::vec3(1.0F) : 1.0F + (crop_colour(Crop::grass) - 1.0F) * drift;
  const LandCoverClass gardens =
      palette.winter ? LandCoverClass::snow : LandCoverClass::valley_floor;
  return glm::mix(street, lawn * palette_colour(palette, gardens, altitude_m, light - 0.08), green);
}

}  // namespace belvedere
