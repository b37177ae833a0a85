#include "terrain/layers/layer_input_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/config.h"
#include "base/error.h"

namespace belvedere {

const std::vector<LayerInputInfo>& layer_input_table() {
  using enum LayerInputKind;
  static const std::vector<LayerInputInfo> table = {
      {"altitude", "m", "above the vertical datum", altitude},
      {"slope", "°", "of the ground smoothed by 45 m", slope},
      {"temperature", "°C", "mean of the year", temperature},
      {"rain", "mm", "of the year, snow as water", rain},
      {"radiation", "MJ/m²", "potential direct radiation of the year, with shadows", radiation},
      {"sky_view", "", "share of the sky that is seen, 0…1", sky_view},
      {"north", "", "exposure: 1 on slopes that face north, -1 south, 0 on level ground", north},
      {"east", "", "exposure: 1 on slopes that face east, -1 west, 0 on level ground", east},
      {"relief_180", "m", "height above the mean of 180 m around", relief, 180.0},
      {"relief_750", "m", "height above the mean of 750 m around", relief, 750.0},
      {"relief_1800", "m", "height above the mean of 1800 m around", relief, 1800.0},
      {"relief_4000", "m", "height above the mean of 4000 m around", relief, 4000.0},
      {"valley_height", "m", "height above the lowest ground within 900 m", valley_height},
      {"log_catchment", "", "log2 of the area that drains through, km²", catchment},
      {"flatness", "", "ln(1 + range of altitude within two cells, m): 0 on lakes", flatness},
      {"roughness", "", "ln(1 + mean departure from the mean of 90 m around, m)", roughness},
  };
  return table;
}

const LayerInputInfo* find_layer_input(std::string_view name) {
  for (const LayerInputInfo& info : layer_input_table())
    if (info.name == name) return &info;
  return nullptr;
}

void require_layer_input(const std::string& name, const std::string& where) {
  if (find_layer_input(name) != nullptr) return;
  std::vector<std::string> known;
  for (const LayerInputInfo& info : layer_input_table()) known.emplace_back(info.name);
  const std::string near = nearest_word(name, known);
  throw Error(ErrorKind::usage, where, fmt::format("unknown input \"{}\"{}", name, near.empty() ? "" : "; did you mean \"" + near + "\"?"),
              fmt::format("{}", fmt::join(known, ", ")));
}

}  // namespace belvedere
