#include "terrain/climate/default_climate.h"

#include <fmt/core.h>
#include <algorithm>
#include <cstddef>

#include "base/angle.h"
#include "base/config.h"
#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/text/embedded.h"
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
  const ConfigValue document = parse_config(text, name);
  const ConfigTable& root = as_table(document, name);
  allow_only(root, {"version", "glaciers"}, name);
  const ConfigValue* version = find(root, "version");
  const ConfigValue* rows = find(root, "glaciers");
  if (version == nullptr || rows == nullptr || as_integer(*version, name) != 1)
    throw Error(ErrorKind::usage, name, "not a table of glaciers", "version = 1 and glaciers");
  std::vector<MeasuredGlacier> glaciers;
  for (const ConfigValue& value : as_array(*rows, name)) {
    const ConfigArray& row = as_array(value, name);
    if (row.size() != 5)
      throw Error(ErrorKind::usage, config_where(name, value.position),
                  fmt::format("a glacier with {} values", row.size()),
                  "5 values: name, latitude, longitude, equilibrium line, source");
    const auto number = [&](std::size_t column, double low, double high) {
      const double found = as_number(row[column], name);
      if (!(found >= low && found <= high))
        throw Error(ErrorKind::usage, config_where(name, row[column].position),
                    describe(row[column]), fmt::format("{} to {}", low, high));
      return found;
    };
    glaciers.push_back({as_string(row[0], name), number(1, -90.0, 90.0), number(2, -180.0, 180.0),
                        number(3, 0.0, 8000.0)});
  }
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
    double way = 0.0;  // squared chord through the Earth
    for (std::size_t axis = 0; axis < here.size(); ++axis)
      way += square(here[axis] - gathering.positions[i][axis]);
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
