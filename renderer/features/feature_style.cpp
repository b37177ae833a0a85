#include "renderer/features/feature_style.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/text/config_reader.h"
#include "base/text/embedded.h"
#include "base/text/letters.h"

namespace belvedere {
namespace {

struct DrawWord {
  const char* word;
  FeatureDraw draw;
  FeatureGeometry geometry;
};
// Every kind of drawing, with its geometry.
constexpr std::array draw_words = {
    DrawWord{"line", FeatureDraw::line, FeatureGeometry::line},
    DrawWord{"band", FeatureDraw::band, FeatureGeometry::line},
    DrawWord{"cable", FeatureDraw::cable, FeatureGeometry::line},
    DrawWord{"building", FeatureDraw::building, FeatureGeometry::point_or_area},
    DrawWord{"river", FeatureDraw::river, FeatureGeometry::line},
    DrawWord{"area", FeatureDraw::area, FeatureGeometry::area},
    DrawWord{"coast", FeatureDraw::coast, FeatureGeometry::line_or_area},
    DrawWord{"town", FeatureDraw::town, FeatureGeometry::point_or_area}};

const DrawWord& row_of(FeatureDraw draw) {
  return *std::find_if(draw_words.begin(), draw_words.end(),
                       [&](const DrawWord& row) { return row.draw == draw; });
}

void read_colours(ConfigReader& read, FeatureColours& to) {
  read.colour("fill", to.fill);
  read.colour("casing", to.casing);
  read.colour("bed", to.bed);
}

FeatureKind read_kind(const ConfigEntry& entry, const std::string& name) {
  FeatureKind kind;
  kind.name = entry.key;
  ConfigReader read(entry.value, name);
  read.texts("also", kind.also);
  std::vector<std::pair<std::string, FeatureDraw>> ways;
  for (const DrawWord& row : draw_words) ways.emplace_back(row.word, row.draw);
  read.word("draw", kind.draw, ways);
  read.number("rank", kind.rank, 0.0, 100.0);
  read.number("width_mm", kind.width_mm, 0.0, 50.0);
  read.number("min_px", kind.min_px, 0.0, 100.0);
  read.number("least_px", kind.min_px, 0.0, 100.0);  // renamed in version 0.2
  read.number("real_m", kind.real_m, 0.0, 10000.0);
  read.number("shrink", kind.shrink, 0.0, 1.0);
  read.number("min_share", kind.min_share, 0.0, 1.0);
  read.number("least_share", kind.min_share, 0.0, 1.0);  // renamed in version 0.2
  read.number("casing_mm", kind.casing_mm, 0.0, 10.0);
  read.number("bed_mm", kind.bed_mm, 0.0, 50.0);
  read.number("soft_mm", kind.soft_mm, 0.0, 20.0);
  read.number("opacity", kind.opacity, 0.0, 1.0);
  read.pair("dash_mm", kind.dash_mm, 0.0, 100.0);
  read.number("hand", kind.hand, 0.0, 1.0);
  read.number("coarsest_m", kind.coarsest_m, 0.0, 1e5);
  read.number("clear_mm", kind.clear_mm, 0.0, 50.0);
  read.number("height_mm", kind.height_mm, 0.0, 50.0);
  read.number("height_m", kind.height_m, 0.0, 500.0);
  read.number("pylon_mm", kind.pylon_mm, 0.0, 500.0);
  read_colours(read, kind.summer);
  kind.winter = kind.summer;
  if (const ConfigValue* winter = read.known("winter")) {
    ConfigReader of_winter(*winter, name);
    read_colours(of_winter, kind.winter);
    of_winter.end();
  }
  read.flag("level", kind.level);
  if (const ConfigValue* ground = read.known("ground")) {
    kind.ground = find_class(as_string(*ground, name));
    if (!kind.ground || *kind.ground == LandCoverClass::sky)
      throw Error(ErrorKind::usage, config_where(name, ground->position), describe(*ground),
                  "a land-cover class, such as \"forest\"");
  }
  read.end();
  if (kind.draw == FeatureDraw::area && !kind.ground)
    throw Error(ErrorKind::usage, config_where(name, entry.key_position),
                fmt::format("the area kind \"{}\" has no class", kind.name),
                "ground = \"forest\" or another class");
  return kind;
}

// A word must not name two kinds.
void check_words(const FeatureStyle& style) {
  std::set<std::string> seen;
  for (const FeatureKind& kind : style.kinds) {
    std::set<std::string> own = {lower_case(kind.name)};
    for (const std::string& word : kind.also) own.insert(lower_case(word));
    for (const std::string& word : own)
      if (!seen.insert(word).second)
        throw Error(ErrorKind::usage, style.name, fmt::format("\"{}\" names two kinds", word),
                    "each word for one kind only");
  }
}

FeatureStyle read_style(const ConfigValue& document, const std::string& name) {
  FeatureStyle style;
  style.name = name;
  ConfigReader read(document, name);
  double version = 0.0;
  read.number("version", version, 1.0, 1.0);
  if (version != 1.0) throw Error(ErrorKind::usage, name, "the version is missing", "version = 1");
  const ConfigValue* kinds = read.known("kinds");
  read.end();
  if (kinds != nullptr)
    for (const ConfigEntry& entry : as_table(*kinds, name))
      style.kinds.push_back(read_kind(entry, name));
  if (style.kinds.empty())
    throw Error(ErrorKind::usage, name, "the style has no kinds",
                "at least one, such as [kinds.road]");
  check_words(style);
  return style;
}

}  // namespace

FeatureGeometry geometry_of(FeatureDraw draw) { return row_of(draw).geometry; }

bool becomes_ground(const FeatureKind& kind) {
  return kind.draw == FeatureDraw::river || kind.draw == FeatureDraw::area ||
         kind.draw == FeatureDraw::coast || kind.draw == FeatureDraw::town;
}

const char* name_of(FeatureDraw draw) { return row_of(draw).word; }

const char* name_of(FeatureGeometry geometry) {
  switch (geometry) {
    case FeatureGeometry::line:
      return "lines";
    case FeatureGeometry::area:
      return "areas";
    case FeatureGeometry::point_or_area:
      return "points or areas";
    case FeatureGeometry::line_or_area:
      return "lines or areas";
  }
  return "";
}

int FeatureStyle::find(const std::string& word) const {
  const std::string wanted = lower_case(word);
  for (std::size_t k = 0; k < kinds.size(); ++k)
    if (lower_case(kinds[k].name) == wanted ||
        std::any_of(kinds[k].also.begin(), kinds[k].also.end(),
                    [&](const std::string& other) { return lower_case(other) == wanted; }))
      return static_cast<int>(k);
  return -1;
}

std::vector<std::string> FeatureStyle::names() const {
  std::vector<std::string> all;
  for (const FeatureKind& kind : kinds) all.push_back(kind.name);
  return all;
}

FeatureStyle parse_feature_style(const std::string& text, const std::string& name) {
  return read_style(parse_config(text, name), name);
}

FeatureStyle load_feature_style(const std::string& name_or_file) {
  if (name_or_file.ends_with(".toml")) return read_style(read_config(name_or_file), name_or_file);
  const std::vector<std::string> names = embedded_names("features");
  if (std::find(names.begin(), names.end(), name_or_file) == names.end())
    throw Error(ErrorKind::usage, "feature style", '"' + name_or_file + '"',
                fmt::format("\"{}\" or a .toml file", fmt::join(names, "\", \"")));
  const std::string file = "features/" + name_or_file + ".toml";
  return parse_feature_style(std::string(embedded_file(file)), file);
}

}  // namespace belvedere
