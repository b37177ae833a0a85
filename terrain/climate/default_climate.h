#pragma once

#include <array>
#include <string>
#include <vector>

#include "terrain/climate/zonal_climate.h"

namespace belvedere {

// The climate of a place of which nothing else is known: what stations say of it, and glaciers of what stays.

// A glacier whose equilibrium line was measured.
struct MeasuredGlacier {
  std::string name;
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double equilibrium_m = 0.0;  // altitude where in a year of balance as much falls as melts
};
// Those that are built in. Error(usage) names the line of a glacier that is not understood, for a text of the same form.
std::vector<MeasuredGlacier> read_measured_glaciers();
std::vector<MeasuredGlacier> measured_glaciers_from_toml(const std::string& text, const std::string& name);

// How far a glacier speaks for others.
struct GlacierKinship {
  double reach_km = 300.0;     // > 0: where it counts a quarter
  double usual_weight = 0.75;  // > 0: of what is usual all over the Earth, beside 1 of a glacier at the place itself
};
// By how much more (or less) than usual hollows gather, at measured glaciers and between them.
struct SnowGathering {
  GlacierKinship kinship;
  std::vector<std::array<double, 3>> places;  // of glaciers, km from the Earth's centre
  std::vector<double> log_gathers;            // of each, ln of PlaceClimate::gathers
};
// At a glacier what is gathered is what must fall at its equilibrium line (snow_to_last_mm) over what does. That makes up for rain that
// stations tell badly: valleys are drier than the glaciers above them, summits as wet.
SnowGathering make_snow_gathering(const ClimateField& field, const std::vector<MeasuredGlacier>& glaciers,
                                  const GlacierKinship& kinship = {});
// At a place, > 0; 1 far from all glaciers.
double gathers_at(const SnowGathering& gathering, double longitude_deg, double latitude_deg);

// From the stations and glaciers that are built in.
PlaceClimate default_climate(double longitude_deg, double latitude_deg);

}  // namespace belvedere
