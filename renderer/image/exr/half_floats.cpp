#include "renderer/image/exr/half_floats.h"

#include <half.h>

#include <algorithm>
#include <cmath>

namespace belvedere {

void to_halves(const float* from, std::size_t step, std::size_t count, std::uint16_t* to) {
  for (std::size_t i = 0; i < count; ++i, from += step) {
    const float v = std::isfinite(*from) ? std::clamp(*from, -static_cast<float>(HALF_MAX),
                                                      static_cast<float>(HALF_MAX))
                                         : *from;
    to[i] = half(v).bits();
  }
}

void from_halves(const std::uint16_t* from, std::size_t count, float* to, std::size_t step) {
  for (std::size_t i = 0; i < count; ++i, to += step) {
    half value;
    value.setBits(from[i]);
    *to = static_cast<float>(value);
  }
}

}  // namespace belvedere
