#include "renderer/style/style_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "base/config.h"
#include "base/error.h"
#include "base/text/config_reader.h"
#include "base/text/hex_colour.h"
#include "base/text/json.h"
#include "renderer/image/srgb.h"

namespace belvedere {
namespace {

constexpr double thousandth = 0.001;
constexpr std::size_t max_residuals = 4096;  // of a third
constexpr std::size_t max_accents = 256;
constexpr int max_sky_side = 32;
const std::array<const char*, 3> third_keys = {"dark", "middle", "light"};

glm::vec3 three_numbers(const ConfigValue& value, const std::string& name, double min, double max) {
  const std::vector<double> numbers = as_numbers(value, name, 3, min, max);
  return {numbers[0], numbers[1], numbers[2]};
}

glm::vec3 lab_colour(const ConfigValue& value, const std::string& name) {
  return glm::vec3(to_oklab(as_colour(value, name)));
}

template <class Read>
auto read_list(const ConfigValue& value, const std::string& name, std::size_t max_count,
               Read read) {
  const ConfigArray& array = as_array(value, name);
  if (array.size() > max_count)
    refuse_value(value, name, fmt::format("{} values", array.size()),
                 fmt::format("at most {}", max_count));
  std::vector<glm::vec3> out;
  for (const ConfigValue& each : array) out.push_back(read(each));
  return out;
}

std::array<double, 4> read_steadiness(const ConfigValue& value, const std::string& name) {
  std::array<double, 4> out{};
  const ConfigArray& numbers = as_array(value, name);
  if (numbers.size() != out.size())
    refuse_value(value, name, fmt::format("{} shares", numbers.size()),
                 "four, at sigmas of 8, 16, 32 and 64 px");
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = as_number(numbers[i], name);
    if (!(out[i] >= 0.0 && out[i] <= (i == 0 ? 1.0 : out[i - 1])))
      refuse_value(numbers[i], name, describe(numbers[i]), "shares in descending order, 0 … 1");
  }
  return out;
}

StyleBrushwork read_brushwork(const ConfigValue& value, const std::string& name) {
  StyleBrushwork out;
  ConfigReader reader(value, name);
  reader.number("length_px", out.length_px, 1.0, 20.0);
  if (out.length_px == 0.0)
    refuse_value(value, name, "no length_px", "length_px and width_px of a class's strokes");
  out.width_px = 0.0;
  reader.number("width_px", out.width_px, 0.5, 5.0);
  if (out.width_px == 0.0)
    refuse_value(value, name, "no width_px", "length_px and width_px of a class's strokes");
  reader.number("level", out.level, -1.0, 1.0);
  reader.number("form", out.form, -1.0, 1.0);
  reader.number("coherence", out.coherence, 0.0, 1.0);
  reader.number("lightness_deviation", out.lightness_deviation, 0.0, 1.0);
  if (const ConfigValue* steadiness = reader.known("steadiness"))
    out.steadiness = read_steadiness(*steadiness, name);
  if (const ConfigValue* accents = reader.known("accents"))
    out.accents = read_list(*accents, name, max_accents,
                            [&](const ConfigValue& v) { return lab_colour(v, name); });
  for (std::size_t third = 0; third < 3; ++third)
    if (const ConfigValue* residuals = reader.known(third_keys[third]))
      out.residuals[third] = read_list(*residuals, name, max_residuals, [&](const ConfigValue& v) {
        return static_cast<float>(thousandth) * three_numbers(v, name, -1000.0, 1000.0);
      });
  reader.end();
  return out;
}

void read_sky_grid(const ConfigValue& value, const std::string& name, StyleSky& sky) {
  ConfigReader reader(value, name);
  if (const ConfigValue* medians = reader.known("medians")) {
    const ConfigArray& rows = as_array(*medians, name);
    const std::size_t columns = rows.empty() ? 0 : as_array(rows.front(), name).size();
    if (columns == 0 || columns > max_sky_side || rows.size() > max_sky_side)
      refuse_value(*medians, name, fmt::format("{} rows of {} colours", rows.size(), columns),
                   fmt::format("1 … {0} rows of 1 … {0} colours", max_sky_side));
    sky.medians = Grid<glm::vec3>(static_cast<int>(columns), static_cast<int>(rows.size()));
    for (std::size_t j = 0; j < rows.size(); ++j) {
      const ConfigArray& row = as_array(rows[j], name);
      if (row.size() != columns)
        refuse_value(rows[j], name, fmt::format("a row of {} colours", row.size()),
                     fmt::format("{}, as in the first row", columns));
      for (std::size_t i = 0; i < columns; ++i)
        sky.medians(static_cast<int>(i), static_cast<int>(j)) = lab_colour(row[i], name);
    }
  }
  reader.number("aspect", sky.aspect, 0.1, 20.0);
  reader.number("upper_edges", sky.upper_edges, -1.0, 1.0);
  if (const ConfigValue* clear = reader.known("clear"))
    sky.clear = three_numbers(*clear, name, -1.0, 1.0);
  reader.number("clear_share", sky.clear_share, 0.0, 1.0);
  if (const ConfigValue* changes = reader.known("changes")) {
    const ConfigArray& array = as_array(*changes, name);
    if (array.size() > 2)
      refuse_value(*changes, name, fmt::format("{} changes", array.size()), "at most two");
    for (const ConfigValue& entry : array) {
      StyleSkyChange change;
      ConfigReader each(entry, name);
      if (const ConfigValue* axis = each.known("axis"))
        change.axis = three_numbers(*axis, name, -1.0, 1.0);
      each.number("length_x", change.length_x, 0.001, 4.0);
      each.number("length_y", change.length_y, 0.001, 4.0);
      if (const ConfigValue* streaks = each.known("streaks")) {
        const glm::vec3 numbers = three_numbers(*streaks, name, 0.0, 1.0);
        for (int s = 0; s < 3; ++s)
          change.streaks[static_cast<std::size_t>(s)] = static_cast<double>(numbers[s]);
      }
      if (const ConfigValue* quantiles = each.known("quantiles")) {
        const ConfigArray& numbers = as_array(*quantiles, name);
        if (numbers.size() != change.quantiles.size())
          refuse_value(*quantiles, name, fmt::format("{} quantiles", numbers.size()),
                       "seven, at shares .02 .1 .25 .5 .75 .9 .98");
        for (std::size_t q = 0; q < numbers.size(); ++q) {
          change.quantiles[q] = as_number(numbers[q], name);
          if (!(std::abs(change.quantiles[q]) <= 100.0) ||
              (q > 0 && change.quantiles[q] < change.quantiles[q - 1]))
            refuse_value(numbers[q], name, describe(numbers[q]),
                         "quantiles in ascending order, -100 … 100");
        }
      }
      each.end();
      sky.changes.push_back(change);
    }
  }
  reader.end();
}

Style build_style(const ConfigValue& root, const std::string& name) {
  const std::vector<std::string>& of_palette = palette_keys();
  ConfigTable palette;
  ConfigTable rest;
  for (const ConfigEntry& entry : as_table(root, name)) {
    const bool shared =
        std::find(of_palette.begin(), of_palette.end(), entry.key) != of_palette.end();
    (shared ? palette : rest).push_back(entry);
  }
  Style style;
  const ConfigValue own{std::move(rest), root.position};
  ConfigReader reader(own, name);
  reader.text("origin", style.origin);
  reader.text("licence", style.licence);
  reader.texts("notes", style.notes);
  reader.number("units_per_px", style.units_per_px, 0.1, 10.0);
  reader.number("broken", style.broken, 0.0, 2.0);
  reader.number("vapour", style.vapour, 0.0, 1.0);
  reader.number("form_deviation", style.form_deviation, 0.0, 1.0);
  reader.number("unevenness", style.unevenness, 0.0, 2.0);
  reader.number("contour_lines", style.contour_lines, 0.0, 1.0);
  if (const ConfigValue* trend = reader.known("trend"))
    style.trend = three_numbers(*trend, name, -1.0, 1.0);
  reader.number("hue_by_light", style.hue_by_light, 0.0, 1.0);
  if (const ConfigValue* brushwork = reader.known("brushwork")) {
    const ConfigTable& classes = as_table(*brushwork, name);
    std::vector<std::string> names;
    for (const LandCoverClassInfo& info : land_cover_classes()) names.emplace_back(info.name);
    allow_only(classes, names, name);
    for (const ConfigEntry& entry : classes)
      style.brushwork[static_cast<std::size_t>(*find_class(entry.key))] =
          read_brushwork(entry.value, name);
  }
  if (const ConfigValue* grid = reader.known("sky_grid")) read_sky_grid(*grid, name, style.sky);
  std::vector<std::string> keys = of_palette;  // all allowed keys, for messages on misspelt ones
  for (const char* key :
       {"origin", "licence", "notes", "units_per_px", "broken", "vapour", "form_deviation",
        "unevenness", "contour_lines", "trend", "hue_by_light", "brushwork", "sky_grid"})
    keys.emplace_back(key);
  allow_only(as_table(root, name), keys, name);
  style.palette = parse_palette(ConfigValue{std::move(palette), root.position}, name);
  style.name = style.palette.name;
  return style;
}

}  // namespace

Style parse_style(std::string_view text, const std::string& name) {
  return build_style(parse_config(text, name), name);
}

Style read_style(const std::string& name_or_path) {
  const NamedConfig read = read_named_config("styles", name_or_path, "style");
  return build_style(read.root, read.name);
}

namespace {

constexpr std::size_t max_line = 100;

std::string quoted_colour(const glm::vec3& rgb) { return '"' + hex_colour(rgb) + '"'; }
std::string quoted_lab(const glm::vec3& lab) { return quoted_colour(from_oklab(lab)); }

// Three decimals, without negative zero and without trailing zeros.
std::string number(double value) {
  std::string text = fmt::format("{:.3f}", value);
  if (text == "-0.000") text = "0.000";
  while (text.ends_with('0') && !text.ends_with(".0")) text.pop_back();
  return text;
}
std::string finer_number(double value) {  // for axes of a sky
  return fmt::format("{:.4f}", std::abs(value) < 0.00005 ? 0.0 : value);
}

std::string thousandths(const glm::vec3& v) {
  const auto whole = [](float x) { return std::lround(1000.0F * x); };
  return fmt::format("[{},{},{}]", whole(v.x), whole(v.y), whole(v.z));
}

// key = [a, b, …], wrapped at max_line.
std::string list(const std::string& key, const std::vector<std::string>& values) {
  std::string joined;
  for (const std::string& value : values) joined += (joined.empty() ? "" : ", ") + value;
  if (std::string line = key + " = [" + joined + "]\n"; line.size() <= max_line) return line;
  std::string out = key + " = [\n";
  std::string line = " ";
  for (const std::string& value : values) {
    if (line.size() + value.size() + 2 > max_line) {
      out += line + "\n";
      line = " ";
    }
    line += " " + value + ",";
  }
  return out + line + "\n]\n";
}

std::string ramp_text(const ToneRamp& ramp) {
  std::string text;
  for (const glm::vec3& colour : ramp) text += (text.empty() ? "" : ", ") + quoted_colour(colour);
  return "[" + text + "]";
}

void add_palette(const Palette& palette, std::string& out) {
  out += "\n# Colours at tone 0 (shadow), 0.34, 0.66 and 1 (full light).\n[classes]\n";
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    const std::vector<ClassPalette::Stop>& stops =
        palette.classes[static_cast<std::size_t>(info.id)].stops;
    if (stops.empty()) continue;
    out += std::string(info.name) + " = ";
    if (stops.size() == 1) {
      out += ramp_text(stops.front().ramp) + "\n";
      continue;
    }
    out += "[\n";
    for (const ClassPalette::Stop& stop : stops)
      out += fmt::format("  {{ altitude_m = {}, ramp = {} }},\n", number(stop.altitude_m),
                         ramp_text(stop.ramp));
    out += "]\n";
  }
  out += "\n# From the top of the picture (0) to the horizon (1).\n[sky]\ngradient = [\n";
  for (const auto& [at, colour] : palette.sky)
    out += fmt::format("  {{ at = {}, colour = {} }},\n", number(at), quoted_colour(colour));
  out += fmt::format("]\ncloud_light = {}\ncloud_shade = {}\n", quoted_colour(palette.cloud_light),
                     quoted_colour(palette.cloud_shade));
  out += fmt::format("\n[air]\nnear = {}\nfar = {}\nbetween_ranges = {}\n",
                     quoted_colour(palette.haze_near), quoted_colour(palette.haze_far),
                     quoted_colour(palette.range_mist));
  std::vector<std::string> leaves;
  for (const glm::vec3& leaf : palette.growth.leaves) leaves.push_back(quoted_colour(leaf));
  out += "\n[growth]\n" + list("leaves", leaves);
  out += fmt::format("leaf_share = {}\nlarch = {}\nlarch_share = {}\n",
                     number(palette.growth.leaf_share), quoted_colour(palette.growth.larch),
                     number(palette.growth.larch_share));
  out += "\n# Shares of what the scene asks for, 0…2.\n[strength]\n";
  out += fmt::format(
      "haze = {}\nwarm_near = {}\nground_drift = {}\nforest_drift = {}\nrock_drift = {}\n",
      number(palette.haze_share), number(palette.warm_share), number(palette.ground_drift_share),
      number(palette.forest_drift_share), number(palette.rock_drift_share));
}

void add_brushwork(std::string_view name, const StyleBrushwork& b, std::string& out) {
  out += fmt::format(
      "\n[brushwork.{}]\nlength_px = {}\nwidth_px = {}\nlevel = {}\nform = {}\n"
      "coherence = {}\nlightness_deviation = {}\n",
      name, number(b.length_px), number(b.width_px), number(b.level), number(b.form),
      number(b.coherence), number(b.lightness_deviation));
  if (b.steadiness.front() > 0.0)
    out += fmt::format("steadiness = [{}, {}, {}, {}]\n", number(b.steadiness[0]),
                       number(b.steadiness[1]), number(b.steadiness[2]), number(b.steadiness[3]));
  std::vector<std::string> accents;
  for (const glm::vec3& accent : b.accents) accents.push_back(quoted_lab(accent));
  out += list("accents", accents);
  constexpr std::array<const char*, 3> keys = {"dark", "middle", "light"};
  for (std::size_t third = 0; third < keys.size(); ++third) {
    std::vector<std::string> residuals;
    for (const glm::vec3& r : b.residuals[third]) residuals.push_back(thousandths(r));
    out += list(keys[third], residuals);
  }
}

void add_sky(const StyleSky& sky, std::string& out) {
  if (sky.medians.empty() && sky.changes.empty()) return;
  out +=
      "\n# Colours of the sky from the top to the horizon, each row from left to right; and how "
      "it changes\n# around them: an axis in OKLab for one deviation of a noise, the distances "
      "(shares of the sky's\n# width and height) at which it has lost half of its correlation, "
      "deviations of\n# its finer scales, and quantiles of its amount.\n# aspect: width over "
      "height of the painting's sky; "
      "upper_edges: how much steeper light is on its upper\n# side, about 0.35 where clouds are "
      "cumulus; clear: the sky between them minus the medians, and its share.\n[sky_grid]\nmedians "
      "= "
      "[\n";
  for (int j = 0; j < sky.medians.height(); ++j) {
    std::string row;
    for (int i = 0; i < sky.medians.width(); ++i)
      row += (i == 0 ? "" : ", ") + quoted_lab(sky.medians(i, j));
    out += "  [" + row + "],\n";
  }
  out += fmt::format(
      "]\naspect = {}\nupper_edges = {}\nclear = [{}, {}, {}]\nclear_share = {}\nchanges = [\n",
      number(sky.aspect), number(sky.upper_edges), number(static_cast<double>(sky.clear.x)),
      number(static_cast<double>(sky.clear.y)), number(static_cast<double>(sky.clear.z)),
      number(sky.clear_share));
  for (const StyleSkyChange& change : sky.changes) {
    std::string quantiles;
    for (const double q : change.quantiles)
      quantiles += (quantiles.empty() ? "" : ", ") + number(q);
    out += fmt::format(
        "  {{ axis = [{}, {}, {}], length_x = {}, length_y = {}, streaks = [{}, {}, {}], "
        "quantiles = [{}] }},\n",
        finer_number(static_cast<double>(change.axis.x)),
        finer_number(static_cast<double>(change.axis.y)),
        finer_number(static_cast<double>(change.axis.z)), number(change.length_x),
        number(change.length_y), number(change.streaks[0]), number(change.streaks[1]),
        number(change.streaks[2]), quantiles);
  }
  out += "]\n";
}

}  // namespace

std::string style_text(const Style& style) {
  std::string out =
      "# The look of a painting: its colours, its brushwork and its sky. Made by `belvedere style "
      "fit`;\n# any of it may be edited. See docs/style.md.\n";
  out += "name = " + json_quoted(style.name) + "\n";
  out += "origin = " + json_quoted(style.origin) + "\n";
  out += "licence = " + json_quoted(style.licence) + "\n";
  out += "winter = " + std::string(style.palette.winter ? "true" : "false") + "\n";
  out += "notes = [\n";
  for (const std::string& note : style.notes) out += "  " + json_quoted(note) + ",\n";
  out += "]\n";
  out += fmt::format(
      "# Units (0.5 mm of the sheet) that a pixel of the painting covers.\nunits_per_px = {}\n"
      "# Contrast of strokes over that of large forms; loss of medium-scale forms in air; their\n"
      "# deviation of lightness; variation of contrast between regions; dark lines on borders.\n"
      "broken = {}\nvapour = {}\nform_deviation = {}\nunevenness = {}\ncontour_lines = {}\n"
      "# Change of L, a and b (OKLab) from the bottom to the top of the ground.\ntrend = [{}, {}, "
      "{}]\n"
      "# Share of the hue's variance that light alone explains.\nhue_by_light = {}\n",
      number(style.units_per_px), number(style.broken), number(style.vapour),
      number(style.form_deviation), number(style.unevenness), number(style.contour_lines),
      number(static_cast<double>(style.trend.x)), number(static_cast<double>(style.trend.y)),
      number(static_cast<double>(style.trend.z)), number(style.hue_by_light));
  add_palette(style.palette, out);
  out +=
      "\n# Strokes of each class. Lengths: pixels of the painting. level: 1 level, -1 upright. "
      "form: "
      "1 along\n# larger forms. coherence: how much neighbours agree in direction. accents: the "
      "most colourful strokes.\n# dark, middle, light: colours of strokes minus the colour around "
      "them (L, a, b in thousandths), by\n# thirds of lightness.\n";
  for (const LandCoverClassInfo& info : land_cover_classes())
    if (const StyleBrushwork& b = style.brushwork[static_cast<std::size_t>(info.id)];
        b.length_px > 0.0)
      add_brushwork(info.name, b, out);
  add_sky(style.sky, out);
  return out;
}

}  // namespace belvedere
