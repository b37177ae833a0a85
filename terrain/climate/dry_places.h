#pragma once

#include <array>
#include <string>
#include <vector>

#include "terrain/climate/zonal_climate.h"

namespace belvedere {

// Dry country behind ranges and far from the sea, which interpolation between stations makes too
// wet: those in reach are on the wet side, or too far away.

struct DryPlace {
  std::string name;
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double radius_km = 0.0;       // 20…700: full effect up to half of it, none from it on
  double floor_m = 0.0;         // altitude of the values below
  double wet_from_m = 0.0;      // altitude from which mountains get the rain of the stations
  double rain_mm = 0.0;         // annual rain on its floor
  double evaporation_mm = 0.0;  // annual evaporation of well-watered ground there
};
// The built-in places. Error(usage) gives the line of a malformed place, for a text of the same
// form.
std::vector<DryPlace> read_dry_places();
std::vector<DryPlace> dry_places_from_toml(const std::string& text, const std::string& name);

struct DryCountry {
  std::vector<DryPlace> places;
  std::vector<std::array<double, 3>> positions;  // of each, km from the Earth's centre
};
DryCountry make_dry_country(std::vector<DryPlace> places);

// The climate of a position with the rain and the dry air of the places around it: less rain, at
// and below the floor in proportion to that of the place, above it in between; and more demand for
// water (PlaceClimate::dry_air). The same bits as before outside every radius.
PlaceClimate dried_climate(const DryCountry& country, const PlaceClimate& climate,
                           double longitude_deg, double latitude_deg);

}  // namespace belvedere
