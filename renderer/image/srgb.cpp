#include "renderer/image/srgb.h"

#include <array>
#include <cstddef>

namespace belvedere {
namespace {

constexpr int intervals = 1024;
constexpr float straight_to = 0.04045F;  // below it the curve of IEC 61966-2-1 is linear

// Coefficients of the cubic of each interval in t = 0…1, lowest power first.
using Cubic = std::array<double, 4>;

// The power function alone; the intervals below straight_to only extend it.
double power(double encoded) { return exact::pow((encoded + 0.055) / 1.055, 2.4); }
double slope(double encoded) {
  return 2.4 / 1.055 * exact::pow((encoded + 0.055) / 1.055, 1.4) / intervals;
}

std::array<Cubic, intervals + 1> make_cubics() {
  std::array<Cubic, intervals + 1> of{};
  for (std::size_t i = 0; i <= intervals; ++i) {
    const double from = static_cast<double>(i) / intervals;
    const double to = from + 1.0 / intervals;
    const double rise = power(to) - power(from);
    of[i] = {power(from), slope(from), 3.0 * rise - 2.0 * slope(from) - slope(to),
             slope(from) + slope(to) - 2.0 * rise};
  }
  return of;
}

}  // namespace

float srgb_decoded_fast(float encoded) {
  static const std::array<Cubic, intervals + 1> cubics = make_cubics();
  if (!(encoded > straight_to && encoded <= 1.0F))
    return static_cast<float>(srgb_decoded(static_cast<double>(encoded)));
  const double at = static_cast<double>(encoded) * intervals;
  const auto i = static_cast<std::size_t>(at);
  const double t = at - static_cast<double>(i);
  const Cubic& c = cubics[i];
  return static_cast<float>(c[0] + t * (c[1] + t * (c[2] + t * c[3])));
}

}  // namespace belvedere
