#pragma once

#include <cmath>

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

}  // namespace belvedere
