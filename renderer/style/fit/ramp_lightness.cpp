#include "renderer/style/fit/ramp_lightness.h"

#include <algorithm>

#include "base/math_exact.h"

namespace belvedere {
namespace {

constexpr double power_step = 0.02;
constexpr double min_power = 0.45;

}  // namespace

LightenedRamps lighten_ramps(const ClassRamps& ramps, double goal, double max_lightness,
                             const LightLaw& law) {
  LightenedRamps out{ramps, 1.0};
  // In small steps, because hue follows the law of light along a curve.
  while (ground_lightness(out.ramps) < goal && out.power > min_power) {
    const double next = out.power - power_step;
    for (std::size_t c = 1; c < out.ramps.size(); ++c) {
      std::array<double, 4> lightness{};
      for (std::size_t k = 0; k < lightness.size(); ++k)
        lightness[k] = max_lightness * exact::pow(std::max(out.ramps[c][k].x, 0.02) / max_lightness,
                                                  next / out.power);
      out.ramps[c] =
          move_lightness(out.ramps[c], lightness, law_of(static_cast<LandCoverClass>(c), law));
    }
    out.power = next;
  }
  return out;
}

}  // namespace belvedere
