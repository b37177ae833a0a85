#pragma once

#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include "renderer/image/srgb.h"

namespace belvedere {

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
