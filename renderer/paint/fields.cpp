#include "renderer/paint/fields.h"

#include <algorithm>
#include <glm/common.hpp>

#include "base/math.h"

namespace belvedere {
namespace {

constexpr float melting_units = 5.0F;  // fields that look narrower than this merge into bands

}  // namespace

glm::vec3 field_colour(const Parcel& parcel, float slope_deg, float metres_per_unit, float air,
                       float drift) {
  const float level = unit((5.5F - slope_deg) / 2.5F);
  const float units = metres_per_unit > 0.0F ? parcel.width_m / metres_per_unit : 100.0F;
  const float apart =
      (0.55F + 0.60F * unit(units / melting_units - 1.0F)) * (1.0F - 0.35F * std::min(air, 1.0F));
  const glm::vec3 crop = crop_colour(parcel.crop) * (1.0F + 0.035F * parcel.shade);
  glm::vec3 colour = glm::mix(mean_crop_colour(), crop, apart);
  const float edge = unit(1.0F - parcel.border_m / (0.10F * parcel.width_m));
  colour *= 1.0F - edge * apart * (parcel.hedged ? 0.13F : 0.05F);
  const float lane = unit(1.0F - parcel.lane_m / (0.06F * parcel.width_m));
  if (!parcel.hedged)
    colour = glm::mix(colour, glm::vec3(1.02F, 0.99F, 1.05F), 0.55F * lane * apart);
  colour = glm::mix(crop_colour(Crop::hay), colour, level);
  return 1.0F + (colour - 1.0F) * drift;
}

}  // namespace belvedere
