#pragma once

#include <glm/vec2.hpp>

#include "base/grid.h"
#include "terrain/climate/stations.h"

namespace belvedere {

// Rain of a mean year at a place, mm: even in x, y and altitude.
struct RainPlane {
  double at_middle_mm = 0.0;       // at `middle` and middle_m
  glm::dvec2 middle{0.0};          // x, y
  double middle_m = 0.0;           // altitude
  double mm_per_km_up = 0.0;       // by altitude
  glm::dvec2 mm_per_km{0.0};       // eastwards, northwards
  double low_mm_per_km_up = 0.0;   // 95 % of bootstrap samples lie between …
  double high_mm_per_km_up = 0.0;  // … these
  double left_out_mm = 0.0;        // rms of the error at a station that the others foretell
  int stations = 0;
  // Never below 0.
  double at(glm::dvec2 place, double altitude_m) const;
};

// Robust regression (Huber's weights at 1.345 deviations, the deviation from the median of residuals) of the stations' rain on altitude
// and, with `fewest_stations` or more, on x and y; with fewer than 4 their median, the same everywhere. x and y are in metres. Stations
// without rain are left out; Error(input) where none is left.
RainPlane fit_rain(const std::vector<Station>& stations, int bootstrap_samples = 400);

// Rain from air that rises over the ground: more on the windward side, less in the lee.
struct UpslopeParameters {
  double wind_from_deg = 270.0;  // 0…360, by the map, clockwise from its top
  double wind_m_s = 12.0;        // 1…50
  double delay_s = 200.0;        // 10…2000, of drops forming, and again of their falling
  double strength = 0.3;         // 0…2, share of a mean year's rain for each m/s that the air rises
};

// What that adds to 1, as a share of the rain over level ground: strength · wind · rise, delayed twice (Smith & Barstad 2004, without
// waves: c iσĥ / (1 + iσT)²). In space each delay is an exponential tail downwind, wind · delay long, which runs along lines over the grid,
// exact for ground that is even between two cells; what lies upwind of the data counts as level. Longer delays than half the half-width of
// the ridges bring the rain down in their lee. Cells in metres; voids (NaN) count as level ground.
Grid<float> upslope_rain(const Grid<float>& altitude_m, glm::dvec2 cell_m, const UpslopeParameters& parameters);

// The least share of the level ground's rain that a lee is left.
inline constexpr float least_rain_share = 0.2F;

}  // namespace belvedere
