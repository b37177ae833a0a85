#include "terrain/climate/default_climate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/matrix/matrix.h"
#include "base/text/embedded.h"
#include "terrain/climate/map_position.h"
#include "terrain/climate/rule_climate.h"
#include "terrain/climate/water_balance.h"

namespace belvedere {
namespace {

constexpr double min_dry_air = 0.05;  // on coasts with fog too, whose air is hardly dry
constexpr double max_dry_air = 3.0;

// The dry air with which plants could use this much water at an altitude.
double dry_air_of(double evaporation_mm, double altitude_m, PlaceClimate climate) {
  climate.dry_air = 0.0;
  const double mild_mm = plant_water_demand_mm(climate, altitude_m);
  climate.dry_air = 1.0;
  const double dry_mm = plant_water_demand_mm(climate, altitude_m);
  return std::clamp((evaporation_mm - mild_mm) / std::max(1.0, dry_mm - mild_mm), min_dry_air,
                    max_dry_air);
}

// Annual evaporation of well-watered ground in dry country: regressed on the table of dry places,
// good to a fifth like its own.
double dry_evaporation_mm(double year_c) { return 970.0 + 39.0 * year_c; }

}  // namespace

std::vector<DryPlace> dry_places_from_toml(const std::string& text, const std::string& name) {
  std::vector<DryPlace> places;
  for_each_row(text, name,
               {"places", "place", 9,
                "name, latitude, longitude, radius, two altitudes, rain, evaporation, cause"},
               [&](const ClimateRow& row) {
                 DryPlace place;
                 place.name = row.text(0);
                 place.latitude_deg = row.number(1, -90.0, 90.0);
                 place.longitude_deg = row.number(2, -180.0, 180.0);
                 place.radius_km = row.number(3, 20.0, 700.0);
                 place.floor_m = row.number(4, -450.0, 6000.0);
                 place.wet_from_m = row.number(5, place.floor_m + 1.0, 7000.0);
                 place.rain_mm = row.number(6, 1.0, 600.0);
                 place.evaporation_mm = row.number(7, 300.0, 3000.0);
                 places.push_back(std::move(place));
               });
  return places;
}

std::vector<DryPlace> read_dry_places() {
  const std::string name = "climate/dry_places.toml";
  return dry_places_from_toml(std::string(embedded_file(name)), name);
}

DryCountry make_dry_country(std::vector<DryPlace> places) {
  DryCountry country;
  for (const DryPlace& place : places)
    country.positions.push_back(earth_position_km(place.longitude_deg, place.latitude_deg));
  country.places = std::move(places);
  return country;
}

PlaceClimate dried_climate(const DryCountry& country, const PlaceClimate& climate,
                           double longitude_deg, double latitude_deg) {
  const std::array<double, 3> here = earth_position_km(longitude_deg, latitude_deg);
  double weights = 0.0;
  double dry_air = 0.0;
  std::array<double, std::tuple_size_v<decltype(climate.rain_mm_at_km)>> log_rain{};
  for (std::size_t i = 0; i < country.places.size(); ++i) {
    const DryPlace& place = country.places[i];
    // All of the effect up to half of the radius, none from it on.
    const double way_km = std::sqrt(squared_chord_km2(here, country.positions[i]));
    const double weight = smoothstep(2.0 * (1.0 - way_km / place.radius_km));
    if (weight <= 0.0) continue;
    weights += weight;
    dry_air += weight * dry_air_of(place.evaporation_mm, place.floor_m, climate);
    const double drier =
        exact::log(std::min(1.0, place.rain_mm / std::max(1.0, rain_mm(climate, place.floor_m))));
    // Rain is linear between whole kilometres: all of the effect up to the first above the floor.
    const double floor_km = std::ceil(1e-3 * place.floor_m);
    const double wet_from_km = std::max(1e-3 * place.wet_from_m, floor_km + 0.5);
    for (std::size_t km = 0; km < log_rain.size(); ++km) {
      const double share =
          std::clamp((wet_from_km - static_cast<double>(km)) / (wet_from_km - floor_km), 0.0, 1.0);
      log_rain[km] += weight * share * drier;
    }
  }
  if (weights <= 0.0) return climate;
  // Where places overlap, their mean.
  const double part = 1.0 / std::max(1.0, weights);
  PlaceClimate dried = climate;
  dried.dry_air = part * dry_air;
  dried.sheltered = part * weights;
  for (std::size_t km = 0; km < log_rain.size(); ++km)
    dried.rain_mm_at_km[km] *= exact::exp(part * log_rain[km]);
  return dried;
}

namespace {

constexpr double dry_floor_mm = 10.0;       // makes deserts with 1 and with 5 mm similar
constexpr double dry_reach_km = 100.0;      // covariance 1 / (1 + d² / 2L²)
constexpr double dry_own = 0.15;            // variance of a place's own, as a share of the field's
constexpr double dry_station_share = 0.42;  // of rain in evaporation, up to which stations are dry
constexpr double coldest_dry_c = -5.0;      // mean of the year: ice sheets are no dry country

double dry_covariance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return 1.0 / (1.0 + squared_chord_km2(a, b) / (2.0 * square(dry_reach_km)));
}

}  // namespace

DryField make_dry_field(const std::vector<DryPlace>& places,
                        const std::vector<ClimateStation>& stations) {
  DryField field;
  std::vector<double> logs;
  const auto add = [&](double longitude_deg, double latitude_deg, double mm) {
    field.positions.push_back(earth_position_km(longitude_deg, latitude_deg));
    logs.push_back(exact::log(mm + dry_floor_mm));
  };
  for (const DryPlace& place : places) add(place.longitude_deg, place.latitude_deg, place.rain_mm);
  for (const ClimateStation& station : stations) {
    double year_c = 0.0;
    for (const double season_c : station.season_c) year_c += 0.25 * season_c;
    if (station.rain_mm >= 0.0 && year_c > coldest_dry_c &&
        station.rain_mm < dry_station_share * dry_evaporation_mm(year_c))
      add(station.longitude_deg, station.latitude_deg, station.rain_mm);
  }
  const std::size_t n = logs.size();
  Matrix covariance(n, n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j)
      covariance(i, j) = dry_covariance(field.positions[i], field.positions[j]);
    covariance(i, i) += dry_own;
  }
  const std::optional<Cholesky> factors = Cholesky::of(std::move(covariance));
  if (!factors) throw Error(ErrorKind::bug, "dry country", "its covariance is not positive");
  // The mean by generalized least squares, in which clusters of places count less.
  const std::vector<double> ones = factors->solve(std::vector<double>(n, 1.0));
  double sum = 0.0;
  double weight = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += ones[i] * logs[i];
    weight += ones[i];
  }
  field.mean = sum / weight;
  for (double& value : logs) value -= field.mean;
  field.weights = factors->solve(logs);
  return field;
}

const DryField& built_in_dry_field() {
  static const DryField field = make_dry_field(read_dry_places(), read_climate_stations());
  return field;
}

PlaceClimate sheltered_climate(const DryField& field, const PlaceClimate& climate,
                               double longitude_deg, double latitude_deg, double floor_m,
                               double sheltered) {
  const std::array<double, 3> here = earth_position_km(longitude_deg, latitude_deg);
  double log_mm = field.mean;
  for (std::size_t i = 0; i < field.positions.size(); ++i)
    log_mm += field.weights[i] * dry_covariance(here, field.positions[i]);
  const double dry_mm = std::max(1.0, exact::exp(log_mm) - dry_floor_mm);
  PlaceClimate dried = climate;
  for (double& mm : dried.rain_mm_at_km)
    if (mm > dry_mm) mm *= exact::exp(sheltered * exact::log(dry_mm / mm));
  const double evaporation_mm = dry_evaporation_mm(year_mean(monthly_c(climate, floor_m)));
  dried.dry_air += sheltered * (dry_air_of(evaporation_mm, floor_m, climate) - climate.dry_air);
  dried.sheltered += sheltered * (1.0 - climate.sheltered);
  return dried;
}

namespace {

// A factor below a third or above three cannot come from the form of hollows; then the climate at
// the glacier is wrong.
constexpr double strangest = 3.0;

}  // namespace

std::vector<MeasuredGlacier> measured_glaciers_from_toml(const std::string& text,
                                                         const std::string& name) {
  std::vector<MeasuredGlacier> glaciers;
  for_each_row(text, name,
               {"glaciers", "glacier", 5, "name, latitude, longitude, equilibrium line, source"},
               [&](const ClimateRow& row) {
                 glaciers.push_back({row.text(0), row.number(1, -90.0, 90.0),
                                     row.number(2, -180.0, 180.0), row.number(3, 0.0, 8000.0)});
               });
  return glaciers;
}

std::vector<MeasuredGlacier> read_measured_glaciers() {
  const std::string name = "climate/glaciers.toml";
  return measured_glaciers_from_toml(std::string(embedded_file(name)), name);
}

SnowGathering make_snow_gathering(const ClimateField& field,
                                  const std::vector<MeasuredGlacier>& glaciers,
                                  const GlacierSimilarity& similarity) {
  SnowGathering gathering{similarity, {}, {}};
  for (const MeasuredGlacier& glacier : glaciers) {
    const PlaceClimate climate = place_climate(field, glacier.longitude_deg, glacier.latitude_deg);
    double snow_mm = 0.0;
    for (const double month_mm : monthly_snow_mm(climate, glacier.equilibrium_m))
      snow_mm += month_mm;
    const double needed_mm = snow_to_last_mm(monthly_c(climate, glacier.equilibrium_m));
    const double usual_mm = SnowParameters{}.gathering * snow_mm;
    gathering.positions.push_back(earth_position_km(glacier.longitude_deg, glacier.latitude_deg));
    gathering.log_gathers.push_back(
        exact::log(std::clamp(needed_mm / std::max(usual_mm, 1.0), 1.0 / strangest, strangest)));
  }
  return gathering;
}

double gathers_at(const SnowGathering& gathering, double longitude_deg, double latitude_deg) {
  const std::array<double, 3> here = earth_position_km(longitude_deg, latitude_deg);
  double sum = 0.0;
  double weight = gathering.similarity.usual_weight;
  for (std::size_t i = 0; i < gathering.positions.size(); ++i) {
    const double way = squared_chord_km2(here, gathering.positions[i]);
    const double k = 1.0 / square(1.0 + way / square(gathering.similarity.reach_km));
    sum += k * gathering.log_gathers[i];
    weight += k;
  }
  return exact::exp(sum / weight);
}

PlaceClimate default_climate(double longitude_deg, double latitude_deg) {
  static const ClimateField field = make_climate_field(read_climate_stations());
  static const SnowGathering gathering = make_snow_gathering(field, read_measured_glaciers());
  static const DryCountry country = make_dry_country(read_dry_places());
  PlaceClimate climate = place_climate(field, longitude_deg, latitude_deg);
  climate.gathers = gathers_at(gathering, longitude_deg, latitude_deg);
  return dried_climate(country, climate, longitude_deg, latitude_deg);
}

}  // namespace belvedere
