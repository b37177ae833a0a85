#include "renderer/features/feature_style.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <utility>

#include "base/config.h"
#include "base/error.h"
#include "base/text/config_reader.h"
#include "base/text/parse_number.h"
#include "base/text/text_encoding.h"

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
  read.number("real_m", kind.real_m, 0.0, 10000.0);
  read.number("shrink", kind.shrink, 0.0, 1.0);
  read.number("min_share", kind.min_share, 0.0, 1.0);
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
    kind.ground = find_ground_class(as_string(*ground, name));
    if (!kind.ground)
      refuse_value(*ground, name, describe(*ground), "a land-cover class, such as \"forest\"");
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

int FeatureStyle::find(const std::string& word) const { return find_kind(kinds, word); }

std::vector<std::string> FeatureStyle::names() const {
  std::vector<std::string> all;
  for (const FeatureKind& kind : kinds) all.push_back(kind.name);
  return all;
}

FeatureStyle parse_feature_style(const std::string& text, const std::string& name) {
  return read_style(parse_config(text, name), name);
}

FeatureStyle load_feature_style(const std::string& name_or_file) {
  const NamedConfig read = read_named_config("features", name_or_file, "style of features");
  return read_style(read.root, read.name);
}

namespace {

constexpr std::size_t max_unknown = 1000;  // different words that are remembered

bool fits(FeatureGeometry wanted, MapShape shape) {
  switch (wanted) {
    case FeatureGeometry::line:
      return shape == MapShape::line;
    case FeatureGeometry::area:
      return shape == MapShape::area;
    case FeatureGeometry::point_or_area:
      return shape != MapShape::line;
    case FeatureGeometry::line_or_area:
      return shape != MapShape::point;
  }
  return false;
}

// "7.5", "7,5", "12 m"; nothing for other text.
std::optional<double> metres_of(std::string text) {
  for (char& c : text)
    if (c == ',') c = '.';
  double value = 0.0;
  const auto [stop, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string rest(stop, static_cast<const char*>(text.data() + text.size()));
  if (problem != std::errc() || !(value >= 0.0 && value <= 1e5) ||
      (!rest.empty() && rest != "m" && rest != " m"))
    return std::nullopt;
  return value;
}

int kind_of_word(const FeatureStyle& style, const std::string& word, const std::string& key) {
  const int kind = style.find(word);
  if (kind >= 0) return kind;
  throw Error(ErrorKind::usage, key,
              fmt::format("the style {} has no kind \"{}\"{}", style.name, word,
                          nearest_word_hint(word, style.names())),
              fmt::format("{}", fmt::join(style.names(), ", ")));
}

void add_source(FeatureSet& set, const FeatureSource& source, int number, const std::string& crs,
                const std::optional<MapBox>& ground) {
  const int usual =
      source.kind.empty() ? -1 : kind_of_word(set.style, source.kind, source.key + ".kind");
  MapQuery query{.layer = source.layer, .where = source.where, .columns = {}, .box = ground};
  const bool by_column = !source.kind_of.empty();
  if (by_column) query.columns.push_back(source.kind_of);
  const auto column_of = [&](const std::string& name) -> std::size_t {
    if (!name.empty()) query.columns.push_back(name);
    return query.columns.size() - 1;
  };
  const std::size_t width_at = column_of(source.width_of);
  const std::size_t level_at = column_of(source.level_of);
  const std::size_t people_at = column_of(source.population_of);
  MapFeatures found = read_map_features(source.file, query, crs);
  SourceReading& reading = set.readings.emplace_back();
  reading.file = source.file.path;
  reading.read = found.read;
  reading.without_shape = found.without_shape;
  reading.unplaceable = found.unplaceable;
  reading.at_zero = found.at_zero;
  reading.beside = found.beside;
  reading.low = found.extent.low;
  reading.high = found.extent.high;
  for (MapFeature& one : found.features) {
    int kind = by_column ? set.style.find(one.values[0]) : usual;
    if (kind < 0) kind = usual;
    if (kind < 0) {
      std::string word = one.values[0].substr(0, 60);
      if (reading.unknown.size() < max_unknown || reading.unknown.contains(word))
        ++reading.unknown[word];
      continue;
    }
    const FeatureKind& style = set.style.kinds[static_cast<std::size_t>(kind)];
    if (!fits(geometry_of(style.draw), one.shape)) {
      ++reading.wrong_shape;
      continue;
    }
    Feature feature{.kind = kind,
                    .source = number,
                    .block = source.block,
                    .shape = one.shape,
                    .where = std::move(one.where),
                    .parts = std::move(one.parts)};
    feature.width_mm = static_cast<float>(source.width_mm > 0.0 ? source.width_mm : style.width_mm);
    double real_m = style.real_m;
    if (!source.width_of.empty() && !one.values[width_at].empty()) {
      const std::optional<double> width = metres_of(one.values[width_at]);
      if (width)
        real_m = *width;
      else
        ++reading.wrong_width;
    }
    feature.real_m = static_cast<float>(real_m);
    const auto number_in = [&](const std::string& name, std::size_t column, double min, double max,
                               float& to) {
      if (name.empty() || one.values[column].empty()) return;
      const std::string& text = one.values[column];
      const std::optional<double> value = parse_number<double>(text);
      if (value && *value >= min && *value <= max)
        to = static_cast<float>(*value);
      else
        ++reading.wrong_number;
    };
    number_in(source.level_of, level_at, -500.0, 9000.0, feature.level_m);
    number_in(source.population_of, people_at, 0.0, 1e8, feature.people);
    ++reading.taken;
    set.features.push_back(std::move(feature));
  }
}

}  // namespace

FeatureSet read_feature_set(const FeatureStyle& style, const std::vector<FeatureSource>& sources,
                            const std::string& crs, const std::optional<MapBox>& ground) {
  FeatureSet set{.style = style, .features = {}, .readings = {}};
  for (std::size_t i = 0; i < sources.size(); ++i)
    add_source(set, sources[i], static_cast<int>(i), crs, ground);
  return set;
}

}  // namespace belvedere
