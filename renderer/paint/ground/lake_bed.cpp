#include "renderer/paint/ground/lake_bed.h"

#include <algorithm>
#include <glm/common.hpp>

#include "base/colour/water_colour.h"
#include "renderer/image/oklab.h"

namespace belvedere {
namespace {

constexpr LandCoverClass bed_class = LandCoverClass::scree;
constexpr float max_share = 0.9F;
constexpr float drawn_from_m =
    7.F;  // metres per unit of the sheet from which shallows are drawn wider than they are …
constexpr float max_drawn = 6.0F;  // … and by how much at most: a rim must be seen on a map
constexpr double lighter_share =
    0.5;  // share of the lightness that shallow water adds: painted deep water is already pale

}  // namespace

glm::vec3 shallow_water(glm::vec3 water) {
  const WaterColours above;
  const glm::dvec3 change = to_oklab(above.shallow / 255.F) - to_oklab(above.deep / 255.F);
  return glm::clamp(from_oklab(to_oklab(water) + glm::dvec3(lighter_share, 1.0, 1.0) * change), 0.F,
                    1.F);
}

LakeBed lake_bed(const GroundTint& tint, const Palette& palette, double altitude_m,
                 glm::dvec3 position_m, double footprint_m) {
  LakeBed bed;
  if (palette.winter) return bed;
  bed.depth_m = lake_depth_at(tint, glm::dvec2(position_m));
  if (!(bed.depth_m > 0.F)) return bed;
  bed.tint = tint_shift(tint, palette, bed_class, altitude_m, position_m, footprint_m);
  bed.share = bed.tint.share;
  return bed;
}

LakeBed lake_bed(const Palette& palette, const WaterGround::Place& water, float metres_per_unit) {
  LakeBed bed;
  if (palette.winter || !(water.lake > 0.F)) return bed;
  bed.depth_m =
      std::max(water.depth_m, 0.01F) / std::clamp(metres_per_unit / drawn_from_m, 1.F, max_drawn);
  bed.share = max_share * water.lake;
  return bed;
}

glm::vec3 LakeBed::under(glm::vec3 water, const Palette& palette, double altitude_m,
                         double light) const {
  if (!(depth_m > 0.F)) return water;
  const glm::vec3 ground = tint.over(palette_colour(palette, bed_class, altitude_m, light));
  return glm::mix(water, water_colour(ground, depth_m, {shallow_water(water), water}), share);
}

}  // namespace belvedere
