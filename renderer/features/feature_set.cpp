#include "renderer/features/feature_set.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <optional>
#include <utility>

#include "base/config.h"
#include "base/error.h"

namespace belvedere {
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
  const std::string near = nearest_word(word, style.names());
  throw Error(ErrorKind::usage, key,
              fmt::format("the style {} has no kind \"{}\"{}", style.name, word,
                          near.empty() ? "" : "; did you mean \"" + near + "\"?"),
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
      double value = 0.0;
      const auto [stop, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (problem == std::errc() && stop == text.data() + text.size() && value >= min &&
          value <= max)
        to = static_cast<float>(value);
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
