#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "base/matrix/matrix.h"

namespace belvedere {

using Months = std::array<double, 12>;  // January … December
// Mean of twelve months of equal weight.
double year_mean(const Months& months);

// Length and warmth of the growing season, from twelve monthly means.

// Daily means of 365 days in degrees Celsius: the smooth annual cycle whose means over twelfths of
// the year are exactly the given ones (trigonometric interpolation, each wave divided by its
// attenuation in a monthly mean). Day 0 is 1 January.
std::array<double, 365> daily_c(const Months& months);

struct GrowingSeason {
  double days = 0.0;    // 0…365, days with means above the limit, fractions included
  double mean_c = 0.0;  // of these days; 0 if there are none
};
// Trees grow on days above .9 °C (Paulsen & Körner 2014, A climate-based model to predict potential
// treeline position around the globe, Alpine Botany 124).
GrowingSeason growing_season(const Months& months, double limit_c = 0.9);

struct TreelineParameters {
  double limit_c = 0.9;     // minimum of a growing day
  double min_days = 94.0;   // growing days in a year
  double min_mean_c = 6.4;  // mean of the growing days
};

// Distance from the treeline isotherm in kelvin: the amount by which all months would have to be
// warmer for trees to grow (or colder, < 0, for them to stop growing). -60…60, continuous.
double treeline_excess_k(const Months& months, const TreelineParameters& parameters = {});

// Altitude range in which lines are searched. A condition that holds nowhere gives the first, one
// that holds everywhere the second.
constexpr double lowest_line_m = -2000.0;
constexpr double highest_line_m = 9000.0;
// The highest altitude in that range at which a condition holds: searched from above in steps of
// 100 m, then by bisection to a millimetre.
double highest_m(const std::function<bool(double)>& holds);

// The climate of any position on Earth without local data, interpolated from some 440 stations
// (data/climate/stations.toml). docs/life_zones.md describes the method and its accuracy.

struct ClimateStation {
  std::string name;
  double latitude_deg = 0.0;   // -90…90
  double longitude_deg = 0.0;  // -180…180
  double altitude_m = 0.0;
  std::array<double, 4> season_c{};  // means of January, April, July, October
  double rain_mm = -1.0;             // annual precipitation; below 0: unknown
  double summer_share = 0.5;         // 0…1: share from April to September
};

// Climate at a position as a function of altitude. Temperatures are linear, valid from below the
// treeline to above the snow line; winter inversions in valleys are not included. Rain is linear
// between whole kilometres.
struct PlaceClimate {
  Months sea_level_c{};                   // monthly means, extrapolated to 0 m
  Months lapse_k_per_km{};                // decrease per km of altitude, by month
  std::array<double, 8> rain_mm_at_km{};  // annual precipitation at 0 … 7 km; constant above
  double summer_share = 0.5;              // 0…1: share from April to September
  double gathers = 1.0;                   // > 0: factor on the accumulation where glaciers form
                                          // (terrain/climate/default_climate.h)
  double dry_air = 0.0;  // 0…3: additional demand of plants for water in dry country, relative to
                         // that in a humid climate of this temperature (dry_places.h)
  double sheltered = 0.0;  // 0…1: share of the table of dry places in the rain, which contains the
                           // lee of the ranges around
};

// The built-in stations. Error(usage) gives the line of a malformed station, for a text of the same
// form.
std::vector<ClimateStation> read_climate_stations();
std::vector<ClimateStation> climate_stations_from_toml(const std::string& text,
                                                       const std::string& name);

// Covariance of climates over distance, for temperatures and the logarithm of rain: a wide and a
// near part with standard deviations and reaches, a part that grows with altitude, and a nugget per
// station. Rounded from the values that best predict stations from all others; docs/life_zones.md
// describes further checks.
struct ClimateSimilarity {
  double wide = 4.0;  // K, or in ln(mm)
  double wide_km = 2000.0;
  double near = 1.8;
  double near_km = 500.0;
  double lapse_per_km = 0.5;  // K/km
  double lapse_km = 2500.0;
  double own = 1.0;
  double km_per_km_up =
      300.0;  // a km of altitude counts as this many km of distance, in the near part
};

struct ClimateFieldParameters {
  ClimateSimilarity temperature;
  ClimateSimilarity rain{0.8, 1500.0, 0.6, 250.0, 0.2, 1500.0, 0.25, 300.0};
};

// Interpolated field: values of one kind (months, or rain and its season) as sums over stations.
struct SimilarityField {
  ClimateSimilarity similarity;
  std::vector<std::array<double, 4>>
      stations;    // km from the Earth's centre (x, y, z) and altitude, km
  Matrix trend;    // 6 × kinds
  Matrix weights;  // stations × kinds
};
struct ClimateField {
  SimilarityField temperature;  // of January, April, July, October
  SimilarityField rain;         // ln(mm + 30), summer share
};

// Error(usage) for fewer than 20 stations with rain data.
ClimateField make_climate_field(const std::vector<ClimateStation>& stations,
                                const ClimateFieldParameters& parameters = {});

// Longitude -180…180 (larger values are wrapped), latitude -90…90 degrees.
PlaceClimate place_climate(const ClimateField& field, double longitude_deg, double latitude_deg);

// Monthly means at an altitude.
Months monthly_c(const PlaceClimate& climate, double altitude_m);
// Annual precipitation at an altitude, and its distribution over the months.
double rain_mm(const PlaceClimate& climate, double altitude_m);
Months monthly_rain_mm(const PlaceClimate& climate, double altitude_m);

// Altitude of the treeline on level ground with enough rain, m; `warmer_k` shifts all months. -2000
// if trees grow nowhere, 9000 if they grow up to there.
double treeline_m(const PlaceClimate& climate, double warmer_k = 0.0,
                  const TreelineParameters& parameters = {});

}  // namespace belvedere
