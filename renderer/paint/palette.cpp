#include "renderer/paint/palette.h"

#include <algorithm>
#include <optional>

#include "base/config.h"
#include "base/error.h"
#include "base/text/embedded.h"

namespace belvedere {
namespace {

[[noreturn]] void fail(const ConfigValue& value, const std::string& name, std::string found,
                       std::string allowed) {
  throw Error(ErrorKind::usage, config_where(name, value.position), std::move(found),
              std::move(allowed));
}

const ConfigValue& require(const ConfigTable& table, const char* key, const ConfigValue& parent,
                           const std::string& name) {
  const ConfigValue* value = find(table, key);
  if (value == nullptr)
    fail(parent, name, std::string("the key \"") + key + "\" is missing", "every palette needs it");
  return *value;
}

// "#rrggbb"
glm::vec3 read_colour(const ConfigValue& value, const std::string& name) {
  const std::string& text = as_string(value, name);
  const auto digit = [&](char c) -> int {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
  };
  const bool right =
      text.size() == 7 && text[0] == '#' &&
      std::all_of(text.begin() + 1, text.end(), [&](char c) { return digit(c) >= 0; });
  if (!right)
    fail(value, name, "the colour " + describe(value),
         "\"#rrggbb\" in encoded sRGB, such as \"#7aa3cc\"");
  glm::vec3 colour(0.0F);
  for (int k = 0; k < 3; ++k)
    colour[k] = static_cast<float>(digit(text[1 + 2 * k]) * 16 + digit(text[2 + 2 * k])) / 255.0F;
  return colour;
}

ToneRamp read_ramp(const ConfigValue& value, const std::string& name) {
  const ConfigArray& array = as_array(value, name);
  if (array.size() != ramp_tones.size())
    fail(value, name, "a ramp of " + std::to_string(array.size()) + " colours",
         "four: at tone 0, 0.34, 0.66 and 1");
  ToneRamp ramp{};
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = read_colour(array[i], name);
  return ramp;
}

double read_number(const ConfigValue& value, const std::string& name, double min, double max,
                   const char* meaning) {
  const double number = as_number(value, name);
  if (!(number >= min && number <= max))
    fail(value, name, describe(value),
         std::string(meaning) + ", " + std::to_string(min) + " … " + std::to_string(max));
  return number;
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
    const ConfigTable& table = as_table(entry, name);
    allow_only(table, {"altitude_m", "ramp"}, name);
    const ConfigValue& altitude = require(table, "altitude_m", entry, name);
    const double altitude_m = read_number(altitude, name, -500.0, 9000.0, "an altitude in metres");
    if (!palette.stops.empty() && altitude_m <= palette.stops.back().altitude_m)
      fail(altitude, name, describe(altitude), "an altitude above the one before it");
    palette.stops.push_back({altitude_m, read_ramp(require(table, "ramp", entry, name), name)});
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
    fail(value, name, "no colours for " + missing,
         "a ramp for every class, or based_on = \"summer\"");
}

void read_sky(const ConfigValue& value, const std::string& name, Palette& palette) {
  const ConfigTable& table = as_table(value, name);
  allow_only(table, {"gradient", "cloud_light", "cloud_shade"}, name);
  if (const ConfigValue* gradient = find(table, "gradient")) {
    palette.sky.clear();
    for (const ConfigValue& entry : as_array(*gradient, name)) {
      const ConfigTable& stop = as_table(entry, name);
      allow_only(stop, {"at", "colour"}, name);
      const ConfigValue& at = require(stop, "at", entry, name);
      const double position =
          read_number(at, name, 0.0, 1.0, "from the top of the picture to the horizon");
      if (!palette.sky.empty() && position <= palette.sky.back().first)
        fail(at, name, describe(at), "a position below the one before it");
      palette.sky.emplace_back(position, read_colour(require(stop, "colour", entry, name), name));
    }
    if (palette.sky.empty())
      fail(*gradient, name, "an empty gradient", "at least one { at, colour }");
  }
  if (const ConfigValue* colour = find(table, "cloud_light"))
    palette.cloud_light = read_colour(*colour, name);
  if (const ConfigValue* colour = find(table, "cloud_shade"))
    palette.cloud_shade = read_colour(*colour, name);
}

void read_air(const ConfigValue& value, const std::string& name, Palette& palette) {
  const ConfigTable& table = as_table(value, name);
  allow_only(table, {"near", "far", "between_ranges"}, name);
  if (const ConfigValue* colour = find(table, "near"))
    palette.haze_near = read_colour(*colour, name);
  if (const ConfigValue* colour = find(table, "far")) palette.haze_far = read_colour(*colour, name);
  if (const ConfigValue* colour = find(table, "between_ranges"))
    palette.range_mist = read_colour(*colour, name);
}

void read_strength(const ConfigValue& value, const std::string& name, Palette& palette) {
  const ConfigTable& table = as_table(value, name);
  allow_only(table, {"haze", "warm_near", "ground_drift", "forest_drift", "rock_drift"}, name);
  const auto read = [&](const char* key, double& share) {
    if (const ConfigValue* number = find(table, key))
      share = read_number(*number, name, 0.0, 2.0, "a share");
  };
  read("haze", palette.haze_share);
  read("warm_near", palette.warm_share);
  read("ground_drift", palette.ground_drift_share);
  read("forest_drift", palette.forest_drift_share);
  read("rock_drift", palette.rock_drift_share);
}

void read_growth(const ConfigValue& value, const std::string& name, GrowthColours& growth) {
  const ConfigTable& table = as_table(value, name);
  allow_only(table, {"leaves", "leaf_share", "larch", "larch_share"}, name);
  if (const ConfigValue* leaves = find(table, "leaves")) {
    growth.leaves.clear();
    for (const ConfigValue& colour : as_array(*leaves, name))
      growth.leaves.push_back(read_colour(colour, name));
  }
  if (const ConfigValue* share = find(table, "leaf_share"))
    growth.leaf_share = read_number(*share, name, 0.0, 1.0, "a share");
  if (const ConfigValue* colour = find(table, "larch")) growth.larch = read_colour(*colour, name);
  if (const ConfigValue* share = find(table, "larch_share"))
    growth.larch_share = read_number(*share, name, 0.0, 1.0, "a share");
}

bool is_built_in(const std::string& name) {
  const std::vector<std::string> names = embedded_names("palettes");
  return std::find(names.begin(), names.end(), name) != names.end();
}

Palette build_palette(const ConfigValue& root, const std::string& name) {
  const ConfigTable& table = as_table(root, name);
  allow_only(table, palette_keys(), name);
  Palette palette;
  const ConfigValue* base = find(table, "based_on");
  if (base != nullptr) {
    // Only built-in palettes: files that refer to files could form a cycle.
    const std::string& given = as_string(*base, name);
    const std::vector<std::string> names = embedded_names("palettes");
    std::string allowed = "a built-in palette:";
    for (const std::string& each : names) allowed += " " + each;
    const std::string near = nearest_word(given, names);
    if (!is_built_in(given))
      fail(*base, name, "the palette \"" + given + "\"",
           allowed + (near.empty() ? "" : "; nearest is " + near));
    palette = read_palette(given);
  }
  if (const ConfigValue* value = find(table, "name")) palette.name = as_string(*value, name);
  if (palette.name.empty()) palette.name = name;
  if (const ConfigValue* value = find(table, "winter")) palette.winter = as_bool(*value, name);
  const auto section = [&](const char* key, auto read) {
    const ConfigValue* value =
        base == nullptr ? &require(table, key, root, name) : find(table, key);
    if (value != nullptr) read(*value, name, palette);
  };
  section("classes", read_classes);
  section("sky", read_sky);
  if (palette.sky.empty())
    fail(*find(table, "sky"), name, "a sky without a gradient",
         "gradient = [{ at = 0.0, colour = \"#5b8abb\" }, …]");
  section("air", read_air);
  if (const ConfigValue* value = find(table, "growth")) read_growth(*value, name, palette.growth);
  if (const ConfigValue* value = find(table, "strength")) read_strength(*value, name, palette);
  return palette;
}

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

Palette parse_palette(const ConfigValue& root, const std::string& name) {
  return build_palette(root, name);
}

Palette parse_palette(std::string_view text, const std::string& name) {
  return build_palette(parse_config(text, name), name);
}

Palette read_palette(const std::string& name_or_path) {
  if (is_built_in(name_or_path)) {
    const std::string file = "palettes/" + name_or_path + ".toml";
    return parse_palette(embedded_file(file), file);
  }
  if (name_or_path.find('/') == std::string::npos && !name_or_path.ends_with(".toml")) {
    const std::vector<std::string> names = embedded_names("palettes");
    std::string allowed = "a .toml file or one of:";
    for (const std::string& each : names) allowed += " " + each;
    throw Error(ErrorKind::usage, "palette", "\"" + name_or_path + "\"", allowed);
  }
  return build_palette(read_config(name_or_path), name_or_path);
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
