#include "renderer/paint/air.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "base/math.h"
#include "base/math_exact.h"

namespace belvedere {
namespace {

constexpr float far_air =
    0.34F;  // more air where ranges stand one behind the other; crests get it too
constexpr float far_from = 0.13F;  // shares of haze between which ranges become far
constexpr float far_to = 0.38F;
constexpr double usual_haze = AirParameters{}.haze;

}  // namespace

double haze_share(const AirParameters& p, double depth_m, double altitude_m) {
  if (depth_m <= p.from_m) return 0.0;
  const double beyond = (depth_m - p.from_m) / p.scale_m;
  const double by_distance = 1.0 - exact::exp(-exact::pow(beyond, 1.35));
  // Air is thinner at summits and denser in valleys.
  const double by_altitude =
      0.58 + 0.42 * exact::exp(-std::max(altitude_m - p.floor_m, 0.0) / 900.0);
  return p.haze * by_distance * by_altitude;
}

float farness(const AirParameters& p, double depth_m) {
  return static_cast<float>(unit((depth_m - p.from_m - 0.30 * p.scale_m) / (0.5 * p.scale_m)));
}

float far_range_share(const AirParameters& p, double depth_m, double altitude_m) {
  return smoothstep(far_from, far_to, static_cast<float>(haze_share(p, depth_m, altitude_m)));
}

float air_share(const AirParameters& p, const Palette& palette, double depth_m, double altitude_m,
                float far, float raised) {
  const auto veil =
      static_cast<float>(unit(haze_share(p, depth_m, altitude_m) * palette.haze_share));
  const float crest = std::max(raised, 0.0F);
  const float among_ranges = unit(veil * (1.0F - 0.30F * far * crest) - 0.06F * far * crest);
  const auto far_share =
      static_cast<float>(std::min(1.0, p.haze / usual_haze * palette.haze_share));
  return among_ranges + far_air * far_share * std::min(far, 1.0F) * (1.0F - among_ranges);
}

glm::vec3 air_colour(const AirParameters& p, const Palette& palette, double depth_m) {
  const double near_m = 0.88 * p.from_m;
  const double far_m = p.from_m + 1.06 * p.scale_m;
  return glm::mix(palette.haze_near, palette.haze_far,
                  static_cast<float>(unit((depth_m - near_m) / (far_m - near_m))));
}

float foreground_warmth(const AirParameters& p, double depth_m) {
  if (p.from_m <= 0.0) return 0.0F;
  return static_cast<float>(unit(1.0 - (depth_m - 0.82 * p.from_m) / (1.03 * p.from_m)));
}

float green_desaturation(const AirParameters& p, double depth_m) {
  if (p.from_m <= 0.0) return 0.0F;
  return static_cast<float>(unit((depth_m - 0.75 * p.from_m) / (0.75 * p.from_m)));
}

}  // namespace belvedere
