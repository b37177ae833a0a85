#include "terrain/climate/rule_climate.h"

#include <fmt/core.h>

#include <algorithm>
#include <span>

#include "base/error.h"

namespace belvedere {
namespace {

using Between = ClimateColumns::Between;

// The two posts around a coordinate and the weight between them; `count` posts.
Between between(double at, int count) {
  const double held = std::clamp(at, 0.0, static_cast<double>(count - 1));
  const int low = std::min(static_cast<int>(held), std::max(0, count - 2));
  return {low, std::min(low + 1, count - 1), static_cast<float>(held - low)};
}

float mix(float a, float b, float share) { return a + (b - a) * share; }

// A row of a grid of posts interpolated between two of its rows.
float at_post(const Grid<float>& grid, const Between& row, int x) {
  return mix(grid(x, row.low), grid(x, row.high), row.share);
}

bool is_line(ClimateVariable variable) { return variable <= ClimateVariable::season_snow; }

// The grids of a variable: one, or one for each altitude.
std::span<const Grid<float>> levels_of(const RuleClimate& climate, ClimateVariable variable) {
  switch (variable) {
    case ClimateVariable::treeline:
      return {&climate.treeline_m, 1};
    case ClimateVariable::ice_line:
      return {&climate.ice_line_m, 1};
    case ClimateVariable::snow_line:
      return {&climate.snow_line_m, 1};
    case ClimateVariable::season_snow:
      return {&climate.season_snow_m, 1};
    case ClimateVariable::moisture:
      return climate.moisture;
    case ClimateVariable::temperature:
      return climate.temperature_c;
    case ClimateVariable::rain:
      return climate.rain_mm;
  }
  return {&climate.treeline_m, 1};
}

// Columns are planned once for all grids with the same posts.
void check_posts(const RuleClimate& climate) {
  const auto check = [](const Grid<float>& grid, const Grid<float>& first) {
    if (grid.empty() || !grid.same_size(first))
      throw Error(ErrorKind::bug, "climate of class rules", "its grids have different posts");
  };
  for (const Grid<float>* line :
       {&climate.treeline_m, &climate.ice_line_m, &climate.snow_line_m, &climate.season_snow_m})
    check(*line, climate.treeline_m);
  for (const auto* table : {&climate.moisture, &climate.temperature_c, &climate.rain_mm})
    for (const Grid<float>& level : *table)
      check(level, climate.moisture.empty() ? level : climate.moisture.front());
}

}  // namespace

RuleClimate alpine_climate() {
  // The Karwendel as painted in summer, with ample rain for forest.
  const auto one = [](float value) { return Grid<float>(1, 1, value); };
  RuleClimate climate;
  climate.line_posts = climate.table_posts = {0.0, 0.0, 1.0, 1.0};
  climate.treeline_m = one(1820.F);
  climate.ice_line_m = one(2750.F);
  climate.snow_line_m = one(2670.F);
  climate.season_snow_m = one(no_season_snow_m);
  climate.step_m = 4000.0;
  climate.moisture = {one(1.F), one(1.F)};
  climate.temperature_c = {one(11.5F), one(-10.5F)};  // 5.5 K a km
  climate.rain_mm = {one(1000.F), one(2000.F)};
  return climate;
}

ClimateColumns plan_climate_columns(const RuleClimate& climate, const GeoTransform& transform,
                                    int width) {
  check_posts(climate);
  const auto plan = [&](const GeoTransform& posts_at, int posts) {
    const glm::dvec2 first = transform.to_crs(0.0, 0.0);
    const double start = posts_at.to_cell(first.x, first.y).x;
    const double step = transform.cell_x / posts_at.cell_x;
    std::vector<Between> columns;
    columns.reserve(static_cast<std::size_t>(width));
    for (int x = 0; x < width; ++x) columns.push_back(between(start + step * x, posts));
    return columns;
  };
  return {
      plan(climate.line_posts, climate.treeline_m.width()),
      plan(climate.table_posts, climate.moisture.empty() ? 1 : climate.moisture.front().width())};
}

void fill_climate_row(const RuleClimate& climate, const ClimateColumns& columns,
                      ClimateVariable variable, const GeoTransform& transform, int y,
                      const float* altitude_m, float* out) {
  const std::span<const Grid<float>> levels = levels_of(climate, variable);
  const Grid<float>& first = levels.front();
  const GeoTransform& posts_at = is_line(variable) ? climate.line_posts : climate.table_posts;
  const std::vector<Between>& positions = is_line(variable) ? columns.lines : columns.tables;
  const Between row = between(
      posts_at.to_cell(transform.to_crs(0.0, y).x, transform.to_crs(0.0, y).y).y, first.height());

  // The row of each altitude, interpolated between its two rows of posts; a cell then needs two
  // posts at two altitudes.
  const auto posts = static_cast<std::size_t>(first.width());
  std::vector<float> values(levels.size() * posts);
  for (std::size_t k = 0; k < levels.size(); ++k)
    for (int x = 0; x < first.width(); ++x)
      values[k * posts + static_cast<std::size_t>(x)] = at_post(levels[k], row, x);

  const auto along = [&](std::size_t k, const Between& column) {
    const float* of_level = values.data() + k * posts;
    return mix(of_level[column.low], of_level[column.high], column.share);
  };
  if (is_line(variable)) {
    for (std::size_t x = 0; x < positions.size(); ++x) out[x] = along(0, positions[x]);
    return;
  }
  for (std::size_t x = 0; x < positions.size(); ++x) {
    const Between up =
        between((static_cast<double>(altitude_m[x]) - climate.lowest_m) / climate.step_m,
                static_cast<int>(levels.size()));
    out[x] = mix(along(static_cast<std::size_t>(up.low), positions[x]),
                 along(static_cast<std::size_t>(up.high), positions[x]), up.share);
  }
}

void fill_climate_row(const RuleClimate& climate, ClimateVariable variable,
                      const GeoTransform& transform, int y, int width, const float* altitude_m,
                      float* out) {
  fill_climate_row(climate, plan_climate_columns(climate, transform, width), variable, transform, y,
                   altitude_m, out);
}

void for_each_row(const std::string& text, const std::string& name, const ClimateTable& table,
                  FunctionRef<void(const ClimateRow&)> use) {
  const ConfigValue document = parse_config(text, name);
  const ConfigTable& root = as_table(document, name);
  allow_only(root, {"version", table.list}, name);
  const ConfigValue* version = find(root, "version");
  const ConfigValue* rows = find(root, table.list);
  if (version == nullptr || rows == nullptr || as_integer(*version, name) != 1)
    throw Error(ErrorKind::usage, name, fmt::format("not a table of {}", table.list),
                fmt::format("version = 1 and {}", table.list));
  for (const ConfigValue& value : as_array(*rows, name)) {
    const ConfigArray& row = as_array(value, name);
    if (row.size() != table.columns)
      throw Error(ErrorKind::usage, config_where(name, value.position),
                  fmt::format("a {} with {} values", table.one, row.size()),
                  fmt::format("{} values: {}", table.columns, table.values));
    use(ClimateRow(row, name));
  }
}

}  // namespace belvedere
