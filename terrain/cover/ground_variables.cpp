#include "terrain/cover/ground_variables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/config.h"
#include "base/error.h"
#include "base/land_cover_class.h"

namespace belvedere {

const std::vector<GroundVariable>& ground_variables() {
  using Kind = LayerInputKind;
  constexpr auto rules = KnownTo::rules;
  static const std::vector<GroundVariable> table = {
      {.name = "altitude",
       .unit = "m",
       .meaning = "altitude above the vertical datum",
       .input = Kind::altitude},
      {.name = "slope",
       .unit = "°",
       .meaning = "slope of the ground smoothed by 60 m",
       .input = Kind::slope},
      {.name = "slope_smooth",
       .unit = "°",
       .meaning = "the same, smoothed again by 90 m",
       .known_to = rules},
      {.name = "north",
       .meaning =
           "exposure of the same ground: 1 on slopes that face north, -1 south, 0 on level ground",
       .input = Kind::north},
      {.name = "south",
       .meaning = "the opposite: 1 on slopes that face south",
       .input = Kind::south},
      {.name = "east",
       .meaning = "1 on slopes that face east, -1 west, 0 on level ground",
       .input = Kind::east},
      {.name = "relief_180",
       .unit = "m",
       .meaning =
           "height above the mean within 180 m: > 0 on ribs and ridges, < 0 in gullies and valleys",
       .input = Kind::relief,
       .reach_m = 180.0,
       .smooth_m = 30.0},
      {.name = "relief_750",
       .unit = "m",
       .meaning = "… within 750 m",
       .input = Kind::relief,
       .reach_m = 750.0,
       .smooth_m = 30.0},
      {.name = "relief_1800",
       .unit = "m",
       .meaning = "… within 1800 m",
       .input = Kind::relief,
       .reach_m = 1800.0,
       .smooth_m = 120.0},
      {.name = "relief_4000",
       .unit = "m",
       .meaning = "… within 4000 m",
       .input = Kind::relief,
       .reach_m = 4000.0,
       .smooth_m = 120.0},
      {.name = "valley_height",
       .unit = "m",
       .meaning = "height above the lowest ground within 900 m",
       .known_to = rules},
      {.name = "above_valley",
       .unit = "m",
       .meaning = "the same without steps: the lowest ground is smoothed over 300 m; below 0 where "
                  "the ground itself is lower",
       .input = Kind::above_valley},
      {.name = "valley_floor",
       .meaning = "0…1, membership of flat ground at the bottom of valleys (`floor_slope_deg`, "
                  "`floor_height_m`, `floor_highest_m`), smoothed over 60 m",
       .known_to = rules},
      {.name = "log_catchment",
       .meaning = "log2 of the upstream area in km²",
       .input = Kind::catchment},
      {.name = "flatness",
       .meaning = "ln(1 + range of altitude within two cells, m): 0 on lakes",
       .input = Kind::flatness},
      {.name = "roughness",
       .meaning = "ln(1 + mean deviation from the mean within 90 m, m)",
       .input = Kind::roughness},
      {.name = "sun",
       .meaning =
           "annual direct sun divided by that of level open ground at the same position, cast "
           "shadows included: 1.2 on a sunny slope, .6 on a shaded one; on cells of 90 m",
       .known_to = rules},
      {.name = "lake",
       .meaning = "1 on lakes: level ground (`lake_range_m`) of at least `lake_min_cells` cells, "
                  "and voids in the data of that size with a level shore; not at sea",
       .input = Kind::lake},
      {.name = "shore",
       .unit = "m",
       .meaning = "distance to the shore on lakes; 0 elsewhere",
       .known_to = rules},
      {.name = "river", .meaning = "0…1, near rivers with large catchments", .known_to = rules},
      {.name = "riverside",
       .unit = "m",
       .meaning = "distance from the nearest stream with a catchment of 20 km² or more; 1 000 000 "
                  "if there is none",
       .known_to = rules},
      {.name = "sea", .meaning = "1 at sea: see below", .input = Kind::sea},
      {.name = "coast",
       .unit = "m",
       .meaning = "distance of land from the sea; 1 000 000 if there is no sea",
       .known_to = rules},
      {.name = "town",
       .meaning =
           "1 at the centre of a town, 0 at its edge, falling to -4 four radii outside; see below",
       .known_to = rules},
      {.name = "ice", .meaning = "0…1, glaciers: see below", .known_to = rules},
      {.name = "below_rock",
       .meaning = "1 just below rock, falling to 0 over `apron_m` down the fall line; uses the "
                  "layers before the first one that refers to it",
       .known_to = rules},
      {.name = "n60",
       .meaning = "noise of mean 0 and standard deviation 1 with patches of 60 m; the same at the "
                  "same position in any map",
       .noise_m = 60.0},
      {.name = "n210", .meaning = "… of 210 m", .noise_m = 210.0},
      {.name = "n660", .meaning = "… of 660 m", .noise_m = 660.0},
      {.name = "n1800", .meaning = "… of 1800 m", .noise_m = 1800.0},
      {.name = "easting",
       .unit = "m",
       .meaning = "coordinate in the scene's CRS",
       .known_to = rules},
      {.name = "northing", .unit = "m", .meaning = "the same", .known_to = rules},
      {.name = "treeline",
       .unit = "m",
       .meaning = "altitude of the treeline on level ground, from the climate",
       .input = Kind::treeline},
      {.name = "iceline",
       .unit = "m",
       .meaning = "altitude at which accumulation equals melt in hollows that collect snow",
       .known_to = rules},
      {.name = "snowline", .unit = "m", .meaning = "the same on open ground", .known_to = rules},
      {.name = "season_snow",
       .unit = "m",
       .meaning = "altitude above which snow lies on the date of the scene's season; far above all "
                  "ground without a date",
       .known_to = rules},
      {.name = "moisture",
       .meaning = "0…1, available water divided by the demand of plants over a year: 1 in the "
                  "Alps, .7 where forest gives way to steppe, .2 in deserts",
       .known_to = rules},
      {.name = "temperature", .unit = "°C", .meaning = "annual mean", .input = Kind::temperature},
      {.name = "rain",
       .unit = "mm",
       .meaning = "annual precipitation, snow as water",
       .input = Kind::rain},
      {.name = "radiation",
       .unit = "MJ/m²",
       .meaning =
           "annual potential direct radiation with cast shadows, on the ground smoothed by 45 m",
       .known_to = KnownTo::layers,
       .input = Kind::radiation},
      {.name = "sky_view",
       .meaning = "share of the sky that is visible from the same ground, 0…1",
       .known_to = KnownTo::layers,
       .input = Kind::sky_view},
  };
  return table;
}

const GroundVariable* find_ground_variable(std::string_view name) {
  for (const GroundVariable& row : ground_variables())
    if (row.name == name) return &row;
  return nullptr;
}

std::vector<std::string> expression_names(KnownTo who) {
  std::vector<std::string> names;
  for (const GroundVariable& row : ground_variables())
    names.emplace_back(row.known_to == KnownTo::both || row.known_to == who ? row.name
                                                                            : std::string_view());
  for (const LandCoverClassInfo& c : land_cover_classes())
    names.push_back(who == KnownTo::rules ? "is_" + std::string(c.name) : "");
  return names;
}

std::vector<std::string> layer_input_names() {
  std::vector<std::string> names;
  for (const GroundVariable& row : ground_variables())
    if (row.input != LayerInputKind::none) names.emplace_back(row.name);
  return names;
}

LayerInputKind layer_input_kind(std::string_view name) {
  const GroundVariable* row = find_ground_variable(name);
  return row == nullptr ? LayerInputKind::none : row->input;
}

void require_layer_input(const std::string& name, const std::string& where) {
  if (layer_input_kind(name) != LayerInputKind::none) return;
  const std::vector<std::string> known = layer_input_names();
  throw Error(ErrorKind::usage, where,
              fmt::format("unknown input \"{}\"{}", name, nearest_word_hint(name, known)),
              fmt::format("{}", fmt::join(known, ", ")));
}

}  // namespace belvedere
