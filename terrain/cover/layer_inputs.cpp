#include "terrain/cover/layer_inputs.h"

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>

#include "base/error.h"
#include "base/filter.h"
#include "base/grid.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/pyramid.h"
#include "base/statistics.h"
#include "terrain/io/block_means.h"
#include "terrain/shape/derivatives.h"
#include "terrain/shape/hydrology.h"
#include "terrain/shape/valley_floor.h"

namespace belvedere {
namespace {

constexpr double valley_radius_m = 900.0;
constexpr double valley_smooth_m = 300.0;
constexpr double rough_mean_m = 90.0;
constexpr double rough_smooth_m = 120.0;
// Maximum number of cells for drainage; above it blocks of cells are used.
constexpr std::size_t max_catchment_cells = 36'000'000;
constexpr int tile_cells = 512;

const Grid<float>* given_grid(const LayerClimate& climate, LayerInputKind kind) {
  switch (kind) {
    case LayerInputKind::temperature:
      return climate.temperature_c;
    case LayerInputKind::rain:
      return climate.rain_mm;
    case LayerInputKind::radiation:
      return climate.radiation;
    case LayerInputKind::sky_view:
      return climate.sky_view;
    case LayerInputKind::treeline:
      return climate.treeline_m;
    case LayerInputKind::lake:
      return climate.lake;
    case LayerInputKind::sea:
      return climate.sea;
    default:
      return nullptr;
  }
}
bool is_given(LayerInputKind kind) { return kind >= LayerInputKind::temperature; }

// The largest power of two that is at most `size` (at least 1).
int block_for(double size) {
  int factor = 1;
  while (2.0 * factor <= size) factor *= 2;
  return factor;
}

// Four cells of a coarse grid around a fine one, and their weights of the cubic B-spline.
struct Taps {
  int first = 0;
  float weight[4] = {};
};
Taps taps_at(int cell, int factor) {
  const double at = (cell + 0.5) / factor - 0.5;
  const double whole = std::floor(at);
  const std::array<double, 4> w = bspline_weights(at - whole);
  Taps taps{static_cast<int>(whole) - 1};
  std::copy(w.begin(), w.end(), taps.weight);
  return taps;
}

// The values of a coarse grid at fine cells: the same bits for any rectangle.
Grid<float> enlarged(const LayerGround::Coarse& coarse, const PixelRect& cells) {
  const Grid<float>& from = coarse.values;
  std::vector<Taps> columns;
  columns.reserve(static_cast<std::size_t>(cells.width()));
  for (int x = cells.x0; x < cells.x1; ++x) columns.push_back(taps_at(x, coarse.factor));
  const int first_row = taps_at(cells.y0, coarse.factor).first;
  const int last_row = taps_at(cells.y1 - 1, coarse.factor).first + 3;
  Grid<float> across(cells.width(), last_row - first_row + 1);
  for (int j = 0; j < across.height(); ++j) {
    const float* row = from.row(std::clamp(first_row + j, 0, from.height() - 1));
    float* out = across.row(j);
    for (int x = 0; x < cells.width(); ++x) {
      const Taps& taps = columns[static_cast<std::size_t>(x)];
      float sum = 0.F;
      for (int k = 0; k < 4; ++k)
        sum += taps.weight[k] * row[std::clamp(taps.first + k, 0, from.width() - 1)];
      out[x] = sum;
    }
  }
  Grid<float> out(cells.width(), cells.height());
  for (int y = 0; y < out.height(); ++y) {
    const Taps taps = taps_at(cells.y0 + y, coarse.factor);
    const float* a = across.row(taps.first - first_row);
    const float* b = across.row(taps.first + 1 - first_row);
    const float* c = across.row(taps.first + 2 - first_row);
    const float* d = across.row(taps.first + 3 - first_row);
    float* target = out.row(y);
    for (int x = 0; x < out.width(); ++x)
      target[x] = (taps.weight[0] * a[x] + taps.weight[1] * b[x]) +
                  (taps.weight[2] * c[x] + taps.weight[3] * d[x]);
  }
  return out;
}

// Standard deviation, in blocks, of the remaining blur after averaging over blocks and
// interpolating between them: a box of f cells has the variance (f² - 1) / 12, the cubic B-spline
// of blocks f² / 3.
double blur_left(double sigma_cells, int factor) {
  const double f2 = static_cast<double>(factor) * factor;
  return std::sqrt(std::max(0.0, (sigma_cells * sigma_cells - (f2 - 1.0) / 12.0 - f2 / 3.0) / f2));
}

LayerGround::Coarse wide_mean(const Dem& dem, double sigma_m) {
  const double sigma = sigma_m / dem.cell_m();
  const int factor = block_for(sigma / 4.0);
  return {factor, gaussian_blur(block_means(dem.altitude_m, factor), blur_left(sigma, factor))};
}

// The same in a window of a larger terrain, including the ground around it.
LayerGround::Coarse wide_mean_of_part(const Dem& window, const Dem& whole, double sigma_m) {
  const double sigma = sigma_m / window.cell_m();
  const int factor = block_for(sigma / 4.0);
  const GeoTransform& t = window.transform;
  const Surrounded all = surround(block_means(window.altitude_m, factor),
                                  {t.origin_x, t.origin_y, factor * t.cell_x, factor * t.cell_y},
                                  whole, 3.5 * sigma_m);
  const int width = (window.width() + factor - 1) / factor;
  const int height = (window.height() + factor - 1) / factor;
  return {factor, part_of(gaussian_blur(all.altitude_m, blur_left(sigma, factor)),
                          {all.left, all.top, all.left + width, all.top + height})};
}

LayerGround::Coarse lowest_around(const Dem& dem) {
  const double cell = dem.cell_m();
  const int factor = block_for(std::min(valley_radius_m / 16.0, valley_smooth_m / 4.0) / cell);
  const double block_m = cell * factor;
  const double box_m = cell * std::sqrt((static_cast<double>(factor) * factor - 1.0) / 12.0);
  const double left_m = std::sqrt(std::max(0.0, slope_smooth_m * slope_smooth_m - box_m * box_m));
  const Grid<float> smooth = gaussian_blur(block_means(dem.altitude_m, factor), left_m / block_m);
  const int radius = std::max(1, static_cast<int>(std::lround(valley_radius_m / block_m)));
  return {factor,
          gaussian_blur(window_minimum(smooth, radius), blur_left(valley_smooth_m / cell, factor))};
}

LayerGround::Coarse catchments(const Dem& dem) {
  int factor = 1;
  while (dem.altitude_m.size() / static_cast<std::size_t>(factor) /
             static_cast<std::size_t>(factor) >
         max_catchment_cells)
    factor *= 2;
  std::vector<RiverEntry> entries = dem.entries;
  for (RiverEntry& entry : entries) entry.x /= factor, entry.y /= factor;
  Grid<float> area = flow_accumulation_km2(gaussian_blur(block_means(dem.altitude_m, factor), 1.5),
                                           dem.cell_m() * factor, entries);
  parallel_rows(area.height(), [&](int y) {
    for (int x = 0; x < area.width(); ++x)
      area(x, y) =
          static_cast<float>(exact::log2(std::max(1e-12, static_cast<double>(area(x, y)))));
  });
  return {factor, gaussian_blur(area, 0.8)};
}

LayerGround::Coarse departures(const Dem& dem) {
  const double sigma = rough_smooth_m / dem.cell_m();
  const int factor = block_for(sigma / 4.0);
  const LayerGround::Coarse mean = wide_mean(dem, rough_mean_m);
  const Grid<float> blocks = block_means(dem.width(), dem.height(), factor, [&](int y, float* row) {
    const Grid<float> around = enlarged(mean, {0, y, dem.width(), y + 1});
    for (int x = 0; x < dem.width(); ++x) row[x] = std::abs(dem.altitude_m(x, y) - around(x, 0));
  });
  return {factor, gaussian_blur(blocks, blur_left(sigma, factor))};
}

// The blurred ground at some cells, with a border of one cell if there is one, computed in a window
// that starts on the lattice to which wide blurs halve the resolution and is large enough for the
// bits to equal those of the whole.
struct BlurredPart {
  Grid<float> z;
  int x0 = 0, y0 = 0;  // the DEM's cell at z(0, 0)
};
BlurredPart blurred_ground(const Dem& dem, const PixelRect& cells, double sigma_m) {
  const double sigma = sigma_m / dem.cell_m();
  const int step = 2 * block_for(sigma / 4.0);
  const int reach = static_cast<int>(std::ceil(6.0 * sigma)) + 8;
  PixelRect window = intersection(grown(cells, reach), {0, 0, dem.width(), dem.height()});
  window.x0 -= window.x0 % step;
  window.y0 -= window.y0 % step;
  return {gaussian_blur(part_of(dem.altitude_m, window), sigma), window.x0, window.y0};
}

Grid<float> moved_part(const BlurredPart& from, const Grid<float>& values, const PixelRect& cells) {
  return part_of(values, moved(cells, -from.x0, -from.y0));
}

float log1p_of(float value) {
  return static_cast<float>(exact::log(1.0 + static_cast<double>(value)));
}

Grid<float> flatness_of(const Dem& dem, const PixelRect& cells) {
  const PixelRect window = intersection(grown(cells, 2), {0, 0, dem.width(), dem.height()});
  const Grid<float> z = part_of(dem.altitude_m, window);
  const Grid<float> low = window_minimum(z, 2);
  const Grid<float> high = window_maximum(z, 2);
  Grid<float> out(cells.width(), cells.height());
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      const int wx = cells.x0 + x - window.x0;
      const int wy = cells.y0 + y - window.y0;
      out(x, y) = log1p_of(high(wx, wy) - low(wx, wy));
    }
  return out;
}

Grid<float> exposure_of(const BlurredPart& ground, const Dem& dem, const PixelRect& cells,
                        LayerInputKind to) {
  Grid<float> out(cells.width(), cells.height());
  const double cell_x = dem.transform.cell_x;
  const double cell_y = dem.transform.cell_y;
  const auto z = [&](int x, int y) {
    return static_cast<double>(ground.z(std::clamp(x, 0, dem.width() - 1) - ground.x0,
                                        std::clamp(y, 0, dem.height() - 1) - ground.y0));
  };
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      const int cx = cells.x0 + x;
      const int cy = cells.y0 + y;
      const double gx = (z(cx + 1, cy) - z(cx - 1, cy)) / (2.0 * cell_x);
      const double gy = (z(cx, cy + 1) - z(cx, cy - 1)) / (2.0 * cell_y);
      // Rows run south: ground that rises with the row number faces north.
      const double facing = to == LayerInputKind::east    ? -gx
                            : to == LayerInputKind::north ? gy
                                                          : -gy;
      out(x, y) = static_cast<float>(facing / (std::sqrt(gx * gx + gy * gy) + exposure_fade));
    }
  return out;
}

void subtract(Grid<float>& from, const Grid<float>& what) {
  for (std::size_t i = 0; i < from.size(); ++i) from[i] -= what[i];
}

}  // namespace

LayerGround make_layer_ground(const Dem& dem, const LayerClimate& climate,
                              const std::vector<std::string>& names, const Dem* whole) {
  LayerGround ground{&dem, climate, names, std::vector<LayerGround::Coarse>(names.size())};
  for (const std::string& name : names) {
    require_layer_input(name, "inputs");
    const LayerInputKind kind = layer_input_kind(name);
    if (!is_given(kind)) continue;
    const Grid<float>* grid = given_grid(climate, kind);
    if (grid == nullptr)
      throw Error(ErrorKind::usage, "input " + name, "missing from the climate",
                  "a climate with " + name);
    if (!grid->same_size(dem.altitude_m))
      throw Error(ErrorKind::bug, "input " + name, "its grid differs in size from the DEM");
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const GroundVariable& info = *find_ground_variable(names[i]);
    if (info.input == LayerInputKind::relief)
      ground.coarse[i] = whole != nullptr ? wide_mean_of_part(dem, *whole, info.reach_m)
                                          : wide_mean(dem, info.reach_m);
    else if (info.input == LayerInputKind::above_valley)
      ground.coarse[i] = lowest_around(dem);
    else if (info.input == LayerInputKind::catchment)
      ground.coarse[i] = catchments(dem);
    else if (info.input == LayerInputKind::roughness)
      ground.coarse[i] = departures(dem);
  }
  return ground;
}

std::vector<Grid<float>> layer_inputs(const LayerGround& ground, const PixelRect& cells) {
  const Dem& dem = *ground.dem;
  std::vector<Grid<float>> out;
  BlurredPart smooth;                  // by slope_smooth_m, made on first use
  std::map<double, BlurredPart> fine;  // for relief, by smoothing
  const auto made = [&](BlurredPart& part, double sigma_m) -> const BlurredPart& {
    if (part.z.empty()) part = blurred_ground(dem, cells, sigma_m);
    return part;
  };
  for (std::size_t i = 0; i < ground.names.size(); ++i) {
    const GroundVariable& info = *find_ground_variable(ground.names[i]);
    const LayerInputKind kind = info.input;
    switch (kind) {
      case LayerInputKind::altitude:
        out.push_back(part_of(dem.altitude_m, cells));
        break;
      case LayerInputKind::slope: {
        const BlurredPart& from = made(smooth, slope_smooth_m);
        out.push_back(
            moved_part(from, slope_deg(from.z, dem.transform.cell_x, dem.transform.cell_y), cells));
        break;
      }
      case LayerInputKind::north:
      case LayerInputKind::south:
      case LayerInputKind::east:
        out.push_back(exposure_of(made(smooth, slope_smooth_m), dem, cells, kind));
        break;
      case LayerInputKind::relief: {
        const BlurredPart& from = made(fine[info.smooth_m], info.smooth_m);
        out.push_back(moved_part(from, from.z, cells));
        subtract(out.back(), enlarged(ground.coarse[i], cells));
        break;
      }
      case LayerInputKind::above_valley: {
        const BlurredPart& from = made(smooth, slope_smooth_m);
        out.push_back(moved_part(from, from.z, cells));
        subtract(out.back(), enlarged(ground.coarse[i], cells));
        break;
      }
      case LayerInputKind::catchment:
        out.push_back(enlarged(ground.coarse[i], cells));
        break;
      case LayerInputKind::flatness:
        out.push_back(flatness_of(dem, cells));
        break;
      case LayerInputKind::roughness:
        out.push_back(enlarged(ground.coarse[i], cells));
        for (float& value : out.back()) value = log1p_of(std::max(0.F, value));
        break;
      default:
        out.push_back(part_of(*given_grid(ground.climate, kind), cells));
    }
  }
  return out;
}

std::vector<Grid<float>> layer_inputs(const LayerGround& ground) {
  const int width = ground.dem->width();
  const int height = ground.dem->height();
  std::vector<Grid<float>> out(ground.names.size(), Grid<float>(width, height));
  parallel_tiles(width, height, tile_cells, [&](const PixelRect& tile) {
    const std::vector<Grid<float>> part = layer_inputs(ground, tile);
    for (std::size_t i = 0; i < part.size(); ++i)
      for (int y = 0; y < tile.height(); ++y)
        std::copy_n(part[i].row(y), tile.width(), out[i].row(tile.y0 + y) + tile.x0);
  });
  return out;
}

LayerInput layer_input_range(const std::string& name, const Grid<float>& values,
                             const Grid<std::uint8_t>* use) {
  std::vector<float> used;
  used.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    if ((use == nullptr || (*use)[i] != 0) && std::isfinite(values[i])) used.push_back(values[i]);
  if (used.empty())
    throw Error(ErrorKind::input, "input " + name, "no ground to take its range from",
                "at least one cell");
  const auto at = [&](double share) {
    return static_cast<double>(value_at_rank(
        used, static_cast<std::size_t>(std::lround(share * static_cast<double>(used.size() - 1)))));
  };
  LayerInput range{name, at(0.001), at(0.999)};
  if (!(range.low < range.high)) {
    const double wider = std::max(1e-3, std::abs(range.low) * 1e-3);
    range.low -= wider;
    range.high += wider;
  }
  return range;
}

namespace {

// Words of expressions.
constexpr std::array<std::string_view, 14> words = {"and",  "or",    "not",        "min", "max",
                                                    "clip", "clamp", "abs",        "sin", "cos",
                                                    "exp",  "sqrt",  "smoothstep", "hat"};

bool is_name(std::string_view text) {
  const auto letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  return !text.empty() && letter(text[0]) && std::all_of(text.begin(), text.end(), [&](char c) {
    return letter(c) || (c >= '0' && c <= '9');
  });
}

bool means_something(const std::string& name, const std::vector<std::string>& taken) {
  return std::find(words.begin(), words.end(), name) != words.end() ||
         find_ground_variable(name) != nullptr ||
         (name.starts_with("is_") && find_class(name.substr(3))) ||
         std::find(taken.begin(), taken.end(), name) != taken.end();
}

// The name of a parameter or a term.
void take_name(const LayersReader& reader, const ConfigEntry& entry,
               std::vector<std::string>& taken) {
  if (!is_name(entry.key))
    reader.fail(entry.key_position, "the name \"" + entry.key + "\"",
                "letters, digits and _, not starting with a digit");
  if (means_something(entry.key, taken))
    reader.fail(entry.key_position, "the name \"" + entry.key + "\" is already in use",
                "another name");
  taken.push_back(entry.key);
}

}  // namespace

void LayersReader::fail(ConfigPosition position, const std::string& found,
                        const std::string& allowed) const {
  throw Error(ErrorKind::usage, config_where(where, position), found, allowed);
}

void LayersReader::fail_unknown(ConfigPosition position, const std::string& what,
                                const std::string& word,
                                const std::vector<std::string>& known) const {
  fail(position, fmt::format("unknown {} \"{}\"{}", what, word, nearest_word_hint(word, known)),
       fmt::format("{}", fmt::join(known, ", ")));
}

double LayersReader::number_or(const ConfigTable& table, std::string_view key,
                               double otherwise) const {
  const ConfigValue* value = find(table, key);
  return value == nullptr ? otherwise : as_number(*value, where);
}

std::string LayersReader::text_or(const ConfigTable& table, std::string_view key,
                                  const std::string& otherwise) const {
  const ConfigValue* value = find(table, key);
  return value == nullptr ? otherwise : as_string(*value, where);
}

std::string LayersReader::expression(const ConfigValue& value) const {
  const std::string& text = as_string(value, where);
  if (text.empty()) refuse_value(value, where, "empty expression", "an expression");
  return text;
}

LandCoverClass as_ground_class(const ConfigValue& value, const std::string& where) {
  const std::string& word = as_string(value, where);
  if (const std::optional<LandCoverClass> found = find_ground_class(word)) return *found;
  LayersReader{where}.fail_unknown(value.position, "class", word, ground_class_names());
}

LayersDocument read_layers_document(const LayersReader& reader, const ConfigValue& document,
                                    const std::vector<std::string>& own_keys) {
  const ConfigTable& root = as_table(document, reader.where);
  std::vector<std::string> keys = {"version", "name", "parameters", "terms", "layers"};
  keys.insert(keys.end(), own_keys.begin(), own_keys.end());
  allow_only(root, keys, reader.where);
  const ConfigValue& version = required(document, "version", reader.where, "version = 1");
  if (as_integer(version, reader.where) != 1)
    refuse_value(version, reader.where, describe(version), "version = 1");

  LayersDocument read;
  read.name = reader.text_or(root, "name", "");
  std::vector<std::string> taken;
  if (const ConfigValue* parameters = find(root, "parameters"))
    for (const ConfigEntry& entry : as_table(*parameters, reader.where)) {
      take_name(reader, entry, taken);
      read.parameters.emplace_back(entry.key, as_number(entry.value, reader.where));
    }
  if (const ConfigValue* terms = find(root, "terms"))
    for (const ConfigEntry& entry : as_table(*terms, reader.where)) {
      take_name(reader, entry, taken);
      read.terms.emplace_back(entry.key, reader.expression(entry.value));
      read.term_places.push_back(entry.value.position);
    }
  return read;
}

const ConfigArray& layers_of(const LayersReader& reader, const ConfigValue& document) {
  return as_array(required(document, "layers", reader.where, "[[layers]]"), reader.where);
}

}  // namespace belvedere
