#include "renderer/paint/water/lake_ice.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "base/math.h"
#include "base/random_streams.h"

namespace belvedere {
namespace {

constexpr float bare_darker = 0.26F;  // tones: bare ice is darker than snow in the same light
constexpr glm::vec3 bare_hue{0.90F, 0.965F, 0.94F};  // factor on snow's colour
constexpr float max_snow = 0.95F;
constexpr glm::dvec2 drift_axis{0.906,
                                -0.423};  // drifts are stretched from north-west to south-east …
constexpr double drift_length = 2.4;      // … by this factor
constexpr float crack_units = 0.55F;      // half the width of a crack
constexpr float wet_m = 4.0F;             // depth up to which the shore's ice is wet

}  // namespace

LakeIce::LakeIce(std::uint64_t seed)
    : drifts_(stream_seed(seed, Stream::lake_ice, 0), 260.0),
      small_drifts_(stream_seed(seed, Stream::lake_ice, 1), 70.0),
      cracks_(stream_seed(seed, Stream::lake_ice, 2), 520.0),
      stretches_(stream_seed(seed, Stream::lake_ice, 3), 700.0) {}

glm::vec3 LakeIce::colour(const Palette& palette, double altitude_m, double light,
                          glm::dvec3 position_m, float depth_m, float metres_per_unit) {
  const float kept = unit(1.8F - metres_per_unit / 30.0F);
  const double along_m = (position_m.x * drift_axis.x + position_m.y * drift_axis.y) / drift_length;
  const double across_m = position_m.y * drift_axis.x - position_m.x * drift_axis.y;
  const float drift = drifts_(along_m, across_m) + 0.6F * kept * small_drifts_(along_m, across_m);
  // Drifts have an edge: it distinguishes ice from water, which has only its shores.
  const float snow = max_snow * smoothstep(-0.30F, 0.45F, drift);
  const glm::vec3 bare = palette_colour(palette, LandCoverClass::snow, altitude_m,
                                        light - static_cast<double>(bare_darker)) *
                         bare_hue;
  glm::vec3 colour =
      glm::mix(bare, palette_colour(palette, LandCoverClass::snow, altitude_m, light), snow);
  // A crack follows the zero line of slow noise for a stretch: its width in metres is the noise
  // divided by its slope, about 1 per 520 m.
  const float off_m = std::abs(cracks_(position_m.x, position_m.y)) * 520.0F;
  const float stretch = smoothstep(0.5F, 1.1F, stretches_(position_m.x, position_m.y));
  const float crack = stretch * (1.0F - smoothstep(0.3F * crack_units * metres_per_unit,
                                                   crack_units * metres_per_unit + 1.0F, off_m));
  colour *= 1.0F - glm::vec3(0.20F, 0.13F, 0.08F) * crack * (1.0F - 0.6F * snow);
  const float wet = 1.0F - smoothstep(0.0F, wet_m, depth_m);
  colour *= 1.0F - glm::vec3(0.16F, 0.10F, 0.06F) * wet;
  return colour;
}

}  // namespace belvedere
