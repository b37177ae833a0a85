#pragma once

#include <glm/vec2.hpp>

#include "base/grid.h"
#include "terrain/climate/stations.h"

namespace belvedere {

// Mean annual rain at a position, mm: linear in x, y and altitude.
struct RainPlane {
  double at_centre_mm = 0.0;       // at `centre` and centre_m
  glm::dvec2 centre{0.0};          // x, y
  double centre_m = 0.0;           // altitude
  double mm_per_km_up = 0.0;       // by altitude
  glm::dvec2 mm_per_km{0.0};       // eastwards, northwards
  double low_mm_per_km_up = 0.0;   // 95 % of bootstrap samples lie between …
  double high_mm_per_km_up = 0.0;  // … these
  double left_out_mm = 0.0;        // rms error at a station when fitted to the others
  double off_mm = 0.0;             // mean absolute error at the stations
  int stations = 0;
  // Never below 0.
  double at(glm::dvec2 position, double altitude_m) const;
};

// Robust regression (Huber's weights at 1.345 deviations, the deviation from the median of
// residuals) of the stations' rain on altitude and, with at least `fewest_stations`, on x and y;
// with fewer than 4 their median everywhere. x and y are in metres. Stations without rain are left
// out; Error(input) if none is left. `wind_share`: the share of level ground's rain that the wind
// brings to each station, above 0, as many as stations or none: then the plane is that of level
// ground, and plane · share fits the stations.
RainPlane fit_rain(const std::vector<Station>& stations, const std::vector<double>& wind_share = {},
                   int bootstrap_samples = 400);

// Orographic rain: more on the windward side, less in the lee.
struct UpslopeParameters {
  double wind_from_deg = 270.0;  // 0…360, on the map, clockwise from its top
  double wind_m_s = 12.0;        // 1…50
  double delay_s = 200.0;        // 10…2000, time for drops to form, and again for them to fall
  double strength = 0.3;         // 0…2, share of a mean year's rain per m/s of uplift
};

// The relative change of rain over that on level ground: strength · wind · rise, delayed twice
// (Smith & Barstad 2004, without waves: c iσĥ / (1 + iσT)²). In space each delay is an exponential
// tail downwind of length wind · delay along lines over the grid, exact for uplift that is constant
// between two cells. Ground upwind of the data counts as level. With delays above half the
// half-width of the ridges the rain falls in their lee. Cells in metres; voids (NaN) count as level
// ground.
Grid<float> upslope_rain(const Grid<float>& altitude_m, glm::dvec2 cell_m,
                         const UpslopeParameters& parameters);

// The minimum share of level ground's rain that falls in a lee.
inline constexpr float min_rain_share = 0.2F;

}  // namespace belvedere
