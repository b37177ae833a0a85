#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/climate/map_position.h"

namespace belvedere {

// The sun's path through the days of a year, and its radiation through clear air.

// Share of the time from sunrise to sunset in which the sun shines, in each month, 0…1; the rest of
// the time is cloudy. 1: a clear sky.
using MonthShares = std::array<float, 12>;
inline constexpr MonthShares always_sunny = {1.F, 1.F, 1.F, 1.F, 1.F, 1.F,
                                             1.F, 1.F, 1.F, 1.F, 1.F, 1.F};
// From none (a clear sky), one for all months, or twelve; Error(usage) at `where` for others.
MonthShares shares_of_months(const std::vector<float>& given, const std::string& where);

struct SunYearParameters {
  double transmissivity = 0.75;  // of clear air, sun overhead, at sea level: 0.1…1; 1: no
                                 // attenuation; .77 is about Linke's turbidity 3
  int first_day = 1;             // 1…365, of the year
  int last_day = 365;     // 1…365, inclusive; before the first day: across the end of the year
  double step_min = 2.0;  // 0.5…10, minutes between two positions of the sun
  MonthShares sunshine = always_sunny;  // each position counts by the share of its month
};

// One position of the sun, for all the minutes it represents.
struct SunMoment {
  double azimuth_rad = 0.0;  // 0…2π, clockwise from true north
  double sine = 0.0;         // of its elevation angle, > 0
  double cosine = 0.0;
  double exposure_mj = 0.0;  // MJ/m² perpendicular to its rays, above the atmosphere
  double air_mass = 1.0;     // path lengths through the air at sea level, 1: overhead
};

// Declination and distance by Spencer (1971), 1367 W/m², air mass by Kasten & Young (1989).
// Error(usage) for values out of range.
std::vector<SunMoment> sun_moments(double latitude_deg, const SunYearParameters& parameters);

// Declination of the sun, rad, and (mean distance / distance)²; day 1…365.
struct SunOfDay {
  double declination_rad = 0.0;
  double nearness = 1.0;
};
SunOfDay sun_of_day(int day);

// Share of the direct sun that remains at an altitude: transmissivity^(air mass · exp(-altitude /
// 8434.5 m)).
double clear_share(double transmissivity, double air_mass, double altitude_m);

// Energy of all positions of the sun above a horizon, for every sector of azimuths, by altitude and
// latitude. With (up, right, top) the components of the sum of energy · direction over the
// positions of a sector above a tangent, ground of unit normal n gets n · sum.
class SunTable {
 public:
  static constexpr int altitudes = 8;  // linear between them
  static constexpr float min_tangent =
      0.25F;  // added to tangents, so that their bits as a float are steps of about .03 degrees
  static constexpr float max_tangent = 3.75F;  // higher positions are dropped
  static constexpr int step_bits = 14;  // of the 23 bits of a float's fraction, dropped in a step
  static constexpr int steps = 4 << (23 - step_bits);

  // For ground from lowest_m to highest_m, on latitudes from south_deg to north_deg; `sectors` of
  // true azimuth, the first centred on north. Light of a position is distributed to its own sector
  // and the two neighbours by its position between their centres, so that the interpolation between
  // horizons is a parabola. Sums are by right and top of a map whose top is at a true azimuth of
  // grid_north_deg.
  SunTable(double south_deg, double north_deg, double lowest_m, double highest_m,
           double grid_north_deg, int sectors, const SunYearParameters& parameters);

  int latitudes() const { return latitudes_; }
  double south_deg() const { return south_deg_; }
  double latitude_step_deg() const { return latitude_step_deg_; }
  double lowest_m() const { return lowest_m_; }
  double altitude_step_m() const { return altitude_step_m_; }
  // Whether the sun is ever in the sector or next to it.
  bool lit(int sector) const;
  // The nearest step of a tangent, 0 … max_tangent.
  static std::size_t step_of(float tangent) {
    return (std::bit_cast<std::uint32_t>(tangent + min_tangent) - first_bits +
            (1U << (step_bits - 1))) >>
           step_bits;
  }
  // [latitude][step][altitude][up, right, top, 0] of a sector.
  const float* sums(int sector) const {
    return sums_.data() + static_cast<std::size_t>(sector) * stride();
  }

 private:
  static constexpr std::uint32_t first_bits = std::bit_cast<std::uint32_t>(min_tangent);
  std::size_t stride() const {
    return static_cast<std::size_t>(latitudes_) * (steps + 1) * altitudes * 4;
  }

  int latitudes_ = 1;
  double south_deg_ = 0.0;
  double latitude_step_deg_ = 1.0;
  double lowest_m_ = 0.0;
  double altitude_step_m_ = 1.0;
  std::vector<float> sums_;
};

struct RadiationParameters {
  int azimuths = 32;  // 8…360: directions of horizon and sky
  SunYearParameters sun;
};

// Clear-sky light on the ground.
struct Radiation {
  // Potential direct radiation from the first day to the last, MJ per m² of inclined ground; NaN
  // where the ground is void. Where the sun does not always shine: its direct light while it does,
  // and the light of the clouds (overcast_share) from the visible sky.
  Grid<float> direct_mj_m2;
  // Sky-view factor: share of the light of a uniform sky that reaches level ground, the mean of
  // cos² of the horizon, which includes the ground's own slope. 0…1, NaN where the ground is void.
  Grid<float> sky_view;
};

// Light of an overcast sky on level ground, as a share of the direct light of a clear one: .25 of
// .75 in Ångström's formula (Allen and others 1998, FAO 56, equation 35).
inline constexpr float overcast_share = 1.F / 3.F;

// Horizons by sweeps (horizon_sweep.h), one per direction for all days; positions of the sun as
// sums by the tangent of their elevation (SunTable), so that a cell costs one look-up per
// direction. Altitudes in m; voids (NaN) cast no shadow and get no result. Latitude and true north
// are those of each cell; horizons use true north at the centre of the map. There is nothing beyond
// the map. Uses some hundred kilobytes per thread besides its results. The same bits for any
// threads.
Radiation potential_radiation(const Grid<float>& altitude_m, const MapPosition& position,
                              const RadiationParameters& parameters,
                              Progress& progress = silent_progress());

}  // namespace belvedere
