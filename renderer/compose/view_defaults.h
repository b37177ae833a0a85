#pragma once

namespace belvedere {

// What a view has that nobody chose: shares of the distance of its horizon, light by its direction. Proposed views are
// written by these, and scenes that do not say them get them; the rest of what a scene does not say: complete_view.h.

struct HorizonDefaults {
  double air_from_m = 0.0;         // .45 of the horizon's distance: behind the foreground
  double air_scale_m = 0.0;        // .60: far ranges turn blue, and stay readable
  double rim_fade_m = 0.0;         // .035: the end of the data goes under in haze
  double foreground_to_m = 0.0;    // .42: where generalization begins to change
  double background_from_m = 0.0;  // .95
};
// Of the air's colour at most so much.
inline constexpr double view_haze = 0.80;
HorizonDefaults defaults_of_horizon(double far_m);

// Light as painters of panoramas have it: from the upper left, as on maps.
struct PainterSun {
  double azimuth_deg = 0.0;  // 0…360
  double altitude_deg = 0.0;
};
PainterSun painter_sun(double view_azimuth_deg);

// Values as they are written: four figures, of which nobody reads more out of a picture.
double rounded_m(double metres);
// To a multiple of 1 / parts.
double rounded_to(double value, double parts);
// 0…360.
double turned_deg(double degrees);

}  // namespace belvedere
