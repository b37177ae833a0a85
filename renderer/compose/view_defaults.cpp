#include "renderer/compose/view_defaults.h"

#include <cmath>

namespace belvedere {

HorizonDefaults defaults_of_horizon(double far_m) {
  return {.air_from_m = 0.45 * far_m,
          .air_scale_m = 0.60 * far_m,
          .rim_fade_m = 0.035 * far_m,
          .foreground_to_m = 0.42 * far_m,
          .background_from_m = 0.95 * far_m};
}

PainterSun painter_sun(double view_azimuth_deg) {
  constexpr double left_deg = 112.0, altitude_deg = 31.0;
  return {turned_deg(view_azimuth_deg - left_deg), altitude_deg};
}

double rounded_m(double metres) {
  double unit = 1.0;
  while (metres / unit >= 10000.0) unit *= 10.0;
  return std::round(metres / unit) * unit;
}

double rounded_to(double value, double parts) { return std::round(value * parts) / parts; }

double turned_deg(double degrees) { return degrees - 360.0 * std::floor(degrees / 360.0); }

}  // namespace belvedere
