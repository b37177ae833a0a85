#pragma once

#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "renderer/image/srgb.h"

#include "base/math_exact.h"

namespace belvedere {

// OKLab (Ottosson 2020): x lightness 0…1, y green to red, z blue to yellow, about ± .3; equal steps
// look about equally large. From and to encoded sRGB; colours outside sRGB are returned beyond 0…1.
inline glm::dvec3 to_oklab(glm::vec3 encoded) {
  const double r = srgb_decoded(encoded.x);
  const double g = srgb_decoded(encoded.y);
  const double b = srgb_decoded(encoded.z);
  const double l = exact::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = exact::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = exact::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

inline glm::vec3 from_oklab(glm::dvec3 lab) {
  const auto cube = [](double v) { return v * v * v; };
  const double l = cube(lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z);
  const double m = cube(lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z);
  const double s = cube(lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z);
  return {
      static_cast<float>(srgb_encoded(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s)),
      static_cast<float>(srgb_encoded(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s)),
      static_cast<float>(srgb_encoded(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s))};
}

}  // namespace belvedere
