#include "terrain/climate/default_climate.h"

#include <algorithm>
#include <cstddef>

#include "base/angle.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/text/embedded.h"
#include "terrain/climate/climate_table.h"
#include "terrain/climate/dry_places.h"
#include "terrain/climate/map_position.h"
#include "terrain/climate/snow_balance.h"

namespace belvedere {
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
