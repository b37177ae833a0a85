#include <fmt/core.h>

#include <cmath>
#include <glm/common.hpp>

#include "base/text/hex_colour.h"
#include "renderer/image/oklab.h"
#include "renderer/style/style_file.h"

namespace belvedere {
namespace {

constexpr std::size_t max_line = 100;

// A TOML string.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (c == '\n')
      out += "\\n";
    else if (c == '\t')
      out += "\\t";
    else if (byte < 0x20 || byte == 0x7f)
      out += fmt::format("\\u{:04x}", byte);
    else
      out += c;
  }
  return out + "\"";
}

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
  out += "name = " + quoted(style.name) + "\n";
  out += "origin = " + quoted(style.origin) + "\n";
  out += "licence = " + quoted(style.licence) + "\n";
  out += "winter = " + std::string(style.palette.winter ? "true" : "false") + "\n";
  out += "notes = [\n";
  for (const std::string& note : style.notes) out += "  " + quoted(note) + ",\n";
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
