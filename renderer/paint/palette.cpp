#include "renderer/paint/palette.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/config.h"
#include "base/error.h"
#include "base/text/config_reader.h"
#include "base/text/embedded.h"

namespace belvedere {
namespace {

ToneRamp read_ramp(const ConfigValue& value, const std::string& name) {
  const ConfigArray& array = as_array(value, name);
  if (array.size() != ramp_tones.size())
    refuse_value(value, name, "a ramp of " + std::to_string(array.size()) + " colours",
                 "four: at tone 0, 0.34, 0.66 and 1");
  ToneRamp ramp{};
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = as_colour(array[i], name);
  return ramp;
}

// Either one ramp for all altitudes, or an array of { altitude_m, ramp } in ascending order.
ClassPalette read_class(const ConfigValue& value, const std::string& name) {
  const ConfigArray& array = as_array(value, name);
  ClassPalette palette;
  if (array.empty() || !array.front().is_table()) {
    palette.stops.push_back({0.0, read_ramp(value, name)});
    return palette;
  }
  for (const ConfigValue& entry : array) {
    allow_only(as_table(entry, name), {"altitude_m", "ramp"}, name);
    const ConfigValue& altitude = required(entry, "altitude_m", name, "an altitude in metres");
    const double altitude_m = as_number(altitude, name, -500.0, 9000.0);
    if (!palette.stops.empty() && altitude_m <= palette.stops.back().altitude_m)
      refuse_value(altitude, name, describe(altitude), "an altitude above the one before it");
    palette.stops.push_back({altitude_m, read_ramp(required(entry, "ramp", name, "a ramp"), name)});
  }
  return palette;
}

void read_classes(const ConfigValue& value, const std::string& name, Palette& palette) {
  const ConfigTable& table = as_table(value, name);
  allow_only(table, ground_class_names(), name);
  for (const ConfigEntry& entry : table)
    palette.classes[static_cast<std::size_t>(*find_class(entry.key))] =
        read_class(entry.value, name);
  std::string missing;
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    if (info.id == LandCoverClass::sky ||
        !palette.classes[static_cast<std::size_t>(info.id)].stops.empty())
      continue;
    missing += (missing.empty() ? "" : ", ") + std::string(info.name);
  }
  if (!missing.empty())
    refuse_value(value, name, "no colours for " + missing,
                 "a ramp for every class, or based_on = \"summer\"");
}

void read_sky(const ConfigValue& value, const std::string& name, Palette& palette) {
  ConfigReader read(value, name);
  if (const ConfigValue* gradient = read.known("gradient")) {
    palette.sky.clear();
    for (const ConfigValue& entry : as_array(*gradient, name)) {
      allow_only(as_table(entry, name), {"at", "colour"}, name);
      const ConfigValue& at =
          required(entry, "at", name, "from 0, the top of the picture, to 1, the horizon");
      const double position = as_number(at, name, 0.0, 1.0);
      if (!palette.sky.empty() && position <= palette.sky.back().first)
        refuse_value(at, name, describe(at), "a position below the one before it");
      palette.sky.emplace_back(position,
                               as_colour(required(entry, "colour", name, "\"#rrggbb\""), name));
    }
    if (palette.sky.empty())
      refuse_value(*gradient, name, "an empty gradient", "at least one { at, colour }");
  }
  read.colour("cloud_light", palette.cloud_light);
  read.colour("cloud_shade", palette.cloud_shade);
  read.end();
}

void read_air(const ConfigValue& value, const std::string& name, Palette& palette) {
  ConfigReader read(value, name);
  read.colour("near", palette.haze_near);
  read.colour("far", palette.haze_far);
  read.colour("between_ranges", palette.range_mist);
  read.end();
}

void read_strength(const ConfigValue& value, const std::string& name, Palette& palette) {
  ConfigReader read(value, name);
  read.number("haze", palette.haze_share, 0.0, 2.0);
  read.number("warm_near", palette.warm_share, 0.0, 2.0);
  read.number("ground_drift", palette.ground_drift_share, 0.0, 2.0);
  read.number("forest_drift", palette.forest_drift_share, 0.0, 2.0);
  read.number("rock_drift", palette.rock_drift_share, 0.0, 2.0);
  read.end();
}

void read_growth(const ConfigValue& value, const std::string& name, GrowthColours& growth) {
  ConfigReader read(value, name);
  if (const ConfigValue* leaves = read.known("leaves")) {
    growth.leaves.clear();
    for (const ConfigValue& colour : as_array(*leaves, name))
      growth.leaves.push_back(as_colour(colour, name));
  }
  read.number("leaf_share", growth.leaf_share, 0.0, 1.0);
  read.colour("larch", growth.larch);
  read.number("larch_share", growth.larch_share, 0.0, 1.0);
  read.end();
}

}  // namespace

Palette parse_palette(const ConfigValue& root, const std::string& name) {
  const ConfigTable& table = as_table(root, name);
  allow_only(table, palette_keys(), name);
  Palette palette;
  const ConfigValue* base = find(table, "based_on");
  if (base != nullptr) {
    // Only built-in palettes: files that refer to files could form a cycle.
    const std::string& given = as_string(*base, name);
    const std::vector<std::string> names = embedded_names("palettes");
    if (std::find(names.begin(), names.end(), given) == names.end())
      refuse_value(*base, name, "the palette \"" + given + "\"" + nearest_word_hint(given, names),
                   fmt::format("a built-in palette: {}", fmt::join(names, ", ")));
    palette = read_palette(given);
  }
  if (const ConfigValue* value = find(table, "name")) palette.name = as_string(*value, name);
  if (palette.name.empty()) palette.name = name;
  if (const ConfigValue* value = find(table, "winter")) palette.winter = as_bool(*value, name);
  const auto section = [&](const char* key, auto read) {
    const ConfigValue* value =
        base == nullptr ? &required(root, key, name, "a table of every palette") : find(table, key);
    if (value != nullptr) read(*value, name, palette);
  };
  section("classes", read_classes);
  section("sky", read_sky);
  if (palette.sky.empty())
    refuse_value(*find(table, "sky"), name, "a sky without a gradient",
                 "gradient = [{ at = 0.0, colour = \"#5b8abb\" }, …]");
  section("air", read_air);
  if (const ConfigValue* value = find(table, "growth")) read_growth(*value, name, palette.growth);
  if (const ConfigValue* value = find(table, "strength")) read_strength(*value, name, palette);
  return palette;
}

namespace {

glm::vec3 ramp_colour(const ToneRamp& ramp, double tone) {
  const double t = std::clamp(tone, 0.0, 1.0);
  std::size_t i = 0;
  while (i + 2 < ramp.size() && t >= ramp_tones[i + 1]) ++i;
  const auto share = static_cast<float>((t - ramp_tones[i]) / (ramp_tones[i + 1] - ramp_tones[i]));
  return ramp[i] * (1.0F - share) + ramp[i + 1] * share;
}

}  // namespace

const std::vector<std::string>& palette_keys() {
  static const std::vector<std::string> keys = {"name", "based_on", "winter", "classes",
                                                "sky",  "air",      "growth", "strength"};
  return keys;
}

Palette parse_palette(std::string_view text, const std::string& name) {
  return parse_palette(parse_config(text, name), name);
}

Palette read_palette(const std::string& name_or_path) {
  const NamedConfig read = read_named_config("palettes", name_or_path, "palette");
  return parse_palette(read.root, read.name);
}

glm::vec3 palette_colour(const Palette& palette, LandCoverClass id, double altitude_m,
                         double tone) {
  const std::vector<ClassPalette::Stop>& stops =
      palette.classes[static_cast<std::size_t>(id)].stops;
  if (stops.empty())
    throw Error(ErrorKind::bug, "palette " + palette.name,
                "no colours for class " + std::string(class_name(id)));
  std::size_t above = 0;
  while (above < stops.size() && stops[above].altitude_m <= altitude_m) ++above;
  if (above == 0) return ramp_colour(stops.front().ramp, tone);
  if (above == stops.size()) return ramp_colour(stops.back().ramp, tone);
  const ClassPalette::Stop& low = stops[above - 1];
  const ClassPalette::Stop& high = stops[above];
  const auto share =
      static_cast<float>((altitude_m - low.altitude_m) / (high.altitude_m - low.altitude_m));
  return ramp_colour(low.ramp, tone) * (1.0F - share) + ramp_colour(high.ramp, tone) * share;
}

}  // namespace belvedere
