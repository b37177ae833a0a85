#pragma once

#include <array>
#include <string>
#include <vector>

#include "terrain/climate/growing_season.h"

namespace belvedere {

// The climate of any place on Earth, where nothing better is known, from some 440 places whose climate is (data/climate/stations.toml).
// docs/life_zones.md says how it is made and how far it is right.

struct ClimateStation {
  std::string name;
  double latitude_deg = 0.0;   // -90…90
  double longitude_deg = 0.0;  // -180…180
  double altitude_m = 0.0;
  std::array<double, 4> season_c{};  // means of January, April, July, October
  double rain_mm = -1.0;             // rain and snow of a year; below 0: not known
  double summer_share = 0.5;         // 0…1: of it from April to September
};

// A place's climate over altitude. Temperatures are straight lines, which hold from below the treeline to above the line of lasting snow;
// cold air that lies in valleys in winter is not in them. Rain is straight between whole kilometres.
struct PlaceClimate {
  Months sea_level_c{};                   // monthly means, continued to 0 m
  Months lapse_k_per_km{};                // how much colder it is 1 km higher, by month
  std::array<double, 8> rain_mm_at_km{};  // rain and snow of a year at 0 … 7 km; beyond, the last
  double summer_share = 0.5;              // 0…1: of it from April to September
  double gathers = 1.0;                   // > 0: by how much more than usual lies where glaciers begin (terrain/climate/default_climate.h)
};

// The stations that are built in. Error(usage) names the line of a station that is not understood, for a text of the same form.
std::vector<ClimateStation> read_climate_stations();
std::vector<ClimateStation> climate_stations_from_toml(const std::string& text, const std::string& name);

// How likely climates hang together over distance. Temperatures and the logarithm of rain, each: a wide and a near part with standard
// deviations and reaches, a part that grows with altitude, and what a station has for itself. Rounded from what tells
// stations best from all others; docs/life_zones.md says what else they were judged by.
struct ClimateKinship {
  double wide = 4.0;  // K, or of ln(mm)
  double wide_km = 2000.0;
  double near = 1.8;
  double near_km = 500.0;
  double lapse_per_km = 0.5;  // K/km
  double lapse_km = 2500.0;
  double own = 1.0;
  double km_per_km_up = 300.0;  // a km of altitude parts places as this many km of way do, in the near part
};

struct ClimateFieldParameters {
  ClimateKinship temperature;
  ClimateKinship rain{0.8, 1500.0, 0.6, 250.0, 0.2, 1500.0, 0.25, 300.0};
};

// What the stations say everywhere: values of one kind (months, or rain and its season) as sums over stations.
struct KinshipField {
  ClimateKinship kinship;
  std::vector<std::array<double, 4>> stations;  // km from the Earth's centre (x, y, z) and altitude, km
  int kinds = 0;
  std::vector<double> trend;    // 6 × kinds
  std::vector<double> weights;  // stations × kinds
};
struct ClimateField {
  KinshipField temperature;  // of January, April, July, October
  KinshipField rain;         // ln(mm + 30), summer share
};

// Error(usage) for fewer than 20 stations that know their rain.
ClimateField make_climate_field(const std::vector<ClimateStation>& stations, const ClimateFieldParameters& parameters = {});

// Longitude -180…180 (or beyond: turns are taken off), latitude -90…90 degrees.
PlaceClimate place_climate(const ClimateField& field, double longitude_deg, double latitude_deg);

// Monthly means at an altitude.
Months monthly_c(const PlaceClimate& climate, double altitude_m);
// Rain and snow of a year at an altitude, and how it falls by month.
double rain_mm(const PlaceClimate& climate, double altitude_m);
Months monthly_rain_mm(const PlaceClimate& climate, double altitude_m);

}  // namespace belvedere
