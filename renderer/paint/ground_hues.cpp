#include "renderer/paint/ground_hues.h"

#include <algorithm>

#include "base/math.h"
#include "base/random_streams.h"

namespace belvedere {
namespace {

constexpr double n3_sigma_m = 60.0;
constexpr double n8_sigma_m = 210.0;
constexpr double n25_sigma_m = 660.0;
constexpr double n60_sigma_m = 1800.0;

// 1 where `size_m` covers two units of the sheet or more, 0 where it covers less than 2/3.
float visible(float size_m, float metres_per_unit) { return unit(1.5F - metres_per_unit / size_m); }

// > 0 shifts towards ripe yellow, < 0 towards green.
float ripeness(LandCoverClass id, const Patches& p) {
  const ClassRipeness& by = class_info(id).hue.ripeness;
  return by.n8 * p.n8 + by.n3 * p.n3 + by.n25 * p.n25 + by.mean;
}

// Added to the ripeness of high grass.
float dryness(LandCoverClass id, float relief_s_m) {
  if (!has_trait(id, ClassTrait::bleaches)) return 0.0F;
  const float relief = std::clamp(relief_s_m / 12.0F, -1.0F, 1.0F);
  return (relief > 0.0F ? 0.16F : 0.24F) * relief;
}

}  // namespace

GroundNoises::GroundNoises(std::uint64_t seed)
    : n3(stream_seed(seed, Stream::ground_patches, 0), n3_sigma_m),
      n8(stream_seed(seed, Stream::ground_patches, 1), n8_sigma_m),
      n25(stream_seed(seed, Stream::ground_patches, 2), n25_sigma_m),
      n60(stream_seed(seed, Stream::ground_patches, 3), n60_sigma_m) {}

Patches patches_at(GroundNoises& noises, glm::dvec3 position_m, float metres_per_unit) {
  Patches p{};
  p.n3 = noises.n3(position_m.x, position_m.y) *
         visible(static_cast<float>(n3_sigma_m), metres_per_unit);
  p.n8 = noises.n8(position_m.x, position_m.y) *
         visible(static_cast<float>(n8_sigma_m), metres_per_unit);
  p.n25 = noises.n25(position_m.x, position_m.y);
  p.n60 = noises.n60(position_m.x, position_m.y);
  return p;
}

glm::vec3 grass_shift(LandCoverClass id, const Patches& patches, float relief_s_m) {
  const float shift = ripeness(id, patches) + dryness(id, relief_s_m);
  // Ripe grass is yellow, fresh grass green, not blue.
  return (shift > 0.0F ? glm::vec3(0.11F, 0.02F, -0.10F) : glm::vec3(0.10F, 0.01F, 0.02F)) * shift;
}

glm::vec3 hue_drift(LandCoverClass id, const Patches& p, const Palette& palette, float strength) {
  glm::vec3 factor(1.0F);
  if (has_trait(id, ClassTrait::drifts)) {
    const float drift = std::clamp(0.7F * p.n60 + 0.5F * p.n25, -2.0F, 2.0F) *
                        static_cast<float>(palette.ground_drift_share) * strength;
    factor *= 1.0F + glm::vec3(0.035F, 0.02F, -0.03F) * drift;
  }
  if (id == LandCoverClass::rock) {
    const float drift = std::clamp(0.6F * p.n25 + 0.4F * p.n8, -1.0F, 1.6F) *
                        static_cast<float>(palette.rock_drift_share) * strength;
    factor *= 1.0F + glm::vec3(0.042F, 0.0F, -0.045F) * drift;
  }
  if (id == LandCoverClass::forest) {
    const float drift = std::clamp(0.7F * p.n25 + 0.5F * p.n8, -1.5F, 1.5F) *
                        static_cast<float>(palette.forest_drift_share) * strength;
    factor *= 1.0F + glm::vec3(0.07F, 0.01F, -0.05F) * drift;
  }
  return factor;
}

glm::vec3 near_snow_hue(float tone, float slope_deg, float close) {
  const float lit = smoothstep(0.55F, 0.90F, tone);
  const float shade = 1.0F - smoothstep(0.25F, 0.50F, tone);
  const float steep = std::clamp((slope_deg - 26.0F) / 20.0F, -1.0F, 1.0F);
  return 1.0F + close * (lit * glm::vec3(0.008F, 0.0F, -0.022F) +
                         shade * steep * glm::vec3(0.045F, -0.02F, 0.0F));
}

}  // namespace belvedere
