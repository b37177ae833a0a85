#pragma once

#include <array>
#include <string>
#include <vector>

#include "terrain/climate/zonal_climate.h"

namespace belvedere {

// The climate of a position without local data: the climate from stations, corrected by measured
// glaciers and in dry country (terrain/climate/default_climate.h).

// A glacier whose equilibrium line was measured.
struct MeasuredGlacier {
  std::string name;
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double equilibrium_m = 0.0;  // altitude at which accumulation equals ablation
};
// The built-in glaciers. Error(usage) gives the line of a malformed glacier, for a text of the same
// form.
std::vector<MeasuredGlacier> read_measured_glaciers();
std::vector<MeasuredGlacier> measured_glaciers_from_toml(const std::string& text,
                                                         const std::string& name);

// How far the correction of a glacier applies.
struct GlacierSimilarity {
  double reach_km = 300.0;  // > 0: distance at which its weight is a quarter
  double usual_weight =
      0.75;  // > 0: weight of the worldwide average, against 1 of a glacier at its own position
};
// Factor on the accumulation in hollows, at measured glaciers and interpolated between them.
struct SnowGathering {
  GlacierSimilarity similarity;
  std::vector<std::array<double, 3>> positions;  // of glaciers, km from the Earth's centre
  std::vector<double> log_gathers;               // of each, ln of PlaceClimate::gathers
};
// At a glacier the factor is the accumulation needed at its equilibrium line (snow_to_last_mm)
// divided by the modelled one. It corrects for rain that stations represent badly: valleys are
// drier than the glaciers above them, summits as wet.
SnowGathering make_snow_gathering(const ClimateField& field,
                                  const std::vector<MeasuredGlacier>& glaciers,
                                  const GlacierSimilarity& similarity = {});
// At a position, > 0; 1 far from all glaciers.
double gathers_at(const SnowGathering& gathering, double longitude_deg, double latitude_deg);

// The climate interpolated from the built-in stations, glaciers and dry places.
PlaceClimate default_climate(double longitude_deg, double latitude_deg);

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

// The rain of dry country as its places and the dry ones among the stations tell it to each other,
// apart from wet ones: for a lee or a basin that the table does not list. Simple kriging of ln(mm +
// 10); leave-one-out, half of the places are told to a factor of 1.3.
struct DryField {
  std::vector<std::array<double, 3>> positions;  // km from the Earth's centre
  double mean = 0.0;                             // of ln(mm + 10)
  std::vector<double> weights;
};
DryField make_dry_field(const std::vector<DryPlace>& places,
                        const std::vector<ClimateStation>& stations);
const DryField& built_in_dry_field();

// A climate moved into dry country by `sheltered`, 0…1, where the valleys are at floor_m: to the
// rain of the field, if that is less than its own, and to the evaporation that goes with the warmth
// of the floor.
PlaceClimate sheltered_climate(const DryField& field, const PlaceClimate& climate,
                               double longitude_deg, double latitude_deg, double floor_m,
                               double sheltered);

}  // namespace belvedere
