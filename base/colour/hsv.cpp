#include "base/colour/hsv.h"

#include <algorithm>
#include <cmath>

namespace belvedere {

glm::dvec3 to_hsv(glm::dvec3 rgb) {
  const double high = std::max({rgb.x, rgb.y, rgb.z});
  const double range = high - std::min({rgb.x, rgb.y, rgb.z});
  if (!(range > 0.0)) return {0.0, 0.0, high};
  double sixth = 0.0;
  if (high == rgb.x)
    sixth = (rgb.y - rgb.z) / range;
  else if (high == rgb.y)
    sixth = (rgb.z - rgb.x) / range + 2.0;
  else
    sixth = (rgb.x - rgb.y) / range + 4.0;
  return {sixth < 0.0 ? (sixth + 6.0) / 6.0 : sixth / 6.0, range / high, high};
}

glm::dvec3 from_hsv(glm::dvec3 hsv) {
  const double turns = hsv.x - std::floor(hsv.x);
  const auto channel = [&](double from) {
    const double k = std::fmod(from + turns * 6.0, 6.0);
    return hsv.z * (1.0 - hsv.y * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0));
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

}  // namespace belvedere
