#pragma once

#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "base/math_exact.h"

namespace belvedere {

// The curve of IEC 61966-2-1 for one channel, continued beyond 0 and 1. In double, so that the
// float result does not depend on the version of pow that the C library chooses for the machine.
inline double srgb_encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * exact::pow(linear, 1.0 / 2.4) - 0.055;
}
inline double srgb_decoded(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : exact::pow((encoded + 0.055) / 1.055, 2.4);
}

// srgb_decoded for pictures: encoded sRGB to scene-linear as the nearest float or its neighbour,
// from a table in a sixth of the time of a power. Between knots 1/1024 apart it is the cubic with
// the curve's values and slopes there (error below 1e-12; a float near .003, where the power
// begins, is 2e-10 wide). Values outside 0…1 use the power itself.
float srgb_decoded_fast(float encoded);

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

// Encoded sRGB, clamped to 0…1, of CIE L*a*b* (CIE 15:2004) with the white point D50 that ICC and
// TIFF prescribe. L 0…100, a and b about ± 128. The matrix is the inverse of the D50 colorants of
// the sRGB profile (IEC 61966-2-1, adapted by Bradford).
inline glm::vec3 srgb_from_lab(glm::dvec3 lab) {
  const auto inverse = [](double t) {
    constexpr double corner = 6.0 / 29.0;
    return t > corner ? t * t * t : 3.0 * corner * corner * (t - 4.0 / 29.0);
  };
  const double y = (lab.x + 16.0) / 116.0;
  const double X = 0.9642 * inverse(y + lab.y / 500.0);
  const double Y = inverse(y);
  const double Z = 0.8249 * inverse(y - lab.z / 200.0);
  const glm::dvec3 linear{3.1338561 * X - 1.6168667 * Y - 0.4906146 * Z,
                          -0.9787684 * X + 1.9161415 * Y + 0.0334540 * Z,
                          0.0719453 * X - 0.2289914 * Y + 1.4052427 * Z};
  return glm::clamp(
      glm::vec3(srgb_encoded(linear.x), srgb_encoded(linear.y), srgb_encoded(linear.z)), 0.F, 1.F);
}

// L*a*b* of the samples of a TIFF, whole steps of 8 or 16 bits. CIELab (photometric 8): a and b
// signed; ICCLab (9): a and b from -128, and 16 bits reach L = 100 at 0xff00.
inline glm::dvec3 lab_of_tiff(glm::dvec3 steps, int bits, bool icc) {
  const double one = bits == 8 ? 1.0 : 256.0;
  if (icc)
    return {100.0 * steps.x / (bits == 8 ? 255.0 : 65280.0), steps.y / one - 128.0,
            steps.z / one - 128.0};
  const auto is_signed = [&](double step) {
    return step >= 128.0 * one ? step - 256.0 * one : step;
  };
  return {100.0 * steps.x / (256.0 * one - 1.0), is_signed(steps.y) / one,
          is_signed(steps.z) / one};
}

}  // namespace belvedere
