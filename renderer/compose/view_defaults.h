#pragma once

namespace belvedere {

// Defaults of a view: shares of the distance of its horizon, light by its direction. Proposed views
// are written with these, and scenes that leave them open get them; other defaults:
// complete_view.h.

struct HorizonDefaults {
  double air_from_m = 0.0;         // .45 of the horizon's distance: behind the foreground
  double air_scale_m = 0.0;        // .60: far ranges turn blue but stay readable
  double rim_fade_m = 0.0;         // .035: the end of the data disappears in haze
  double foreground_to_m = 0.0;    // .42: where generalization begins to change
  double background_from_m = 0.0;  // .95
};
// Upper limit of the haze's share.
inline constexpr double view_haze = 0.80;
HorizonDefaults defaults_of_horizon(double far_m);

// Light as in painted panoramas: from the upper left, as on maps.
struct PainterSun {
  double azimuth_deg = 0.0;  // 0…360
  double altitude_deg = 0.0;
};
PainterSun painter_sun(double view_azimuth_deg);

// Values rounded to four figures, the precision that a picture can show.
double rounded_m(double metres);
// To a multiple of 1 / parts.
double rounded_to(double value, double parts);
// 0…360.
double turned_deg(double degrees);

}  // namespace belvedere
