#include "renderer/world/scene_dem.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/math_exact.h"
#include "base/memory_limit.h"
#include "renderer/ground/cached_products.h"
#include "renderer/ground/scene_ground_map.h"
#include "renderer/scene/scene_settings.h"
#include "terrain/generalize/destripe.h"
#include "terrain/io/http_access.h"
#include "terrain/io/raster_file.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

void each_field(auto& bytes, FieldsOf<Dem> auto& dem) {
  auto& [altitude_m, filled, transform, crs, entries, halved] = dem;
  bytes(altitude_m, filled, transform, crs);  // as read or made: the rest is for windows
}

namespace {

RasterSource to_raster_source(const LoadedScene& scene, const SceneSource& source) {
  RasterSource raster = source.raster;
  raster.path = find_scene_file(scene, source.file);
  if (source.unit == "m") raster.unit_to_m = 1.0;
  if (source.unit == "ft") raster.unit_to_m = 0.3048;
  if (source.unit == "us-ft") raster.unit_to_m = 1200.0 / 3937.0;
  return raster;
}

CacheKey synthetic_key(const LoadedScene& loaded) {
  const auto& [width, height, cell_m, lowest_m, highest_m, seed] = *loaded.scene.terrain.synthetic;
  CacheKeyText key;
  key.add("width", width).add("height", height).add("cell_m", cell_m);
  key.add("lowest_m", lowest_m).add("highest_m", highest_m).add("seed", seed);
  return make_cache_key(CachedProduct::synthetic_terrain, key, subject_of(loaded));
}

// The files' contents and all settings. Nothing where one of them is on a server.
std::optional<CacheKey> elevation_key(const LoadedScene& loaded, const DemParameters& parameters) {
  const auto& [sources, crs, cell_m, extent, max_void_share] = parameters;
  CacheKeyText key;
  key.add("crs", crs).add("cell_m", cell_m).add("max_void_share", max_void_share);
  if (extent)
    for (const double side : *extent) key.add("extent", side);
  for (const RasterSource& source : sources) {
    const auto& [path, band, variable, encoding, own_crs, unit_to_m, nodata, lowest_m, highest_m,
                 max_spike_m] = source;
    for (const std::string& part : raster_parts(path)) {
      if (is_address(part)) return std::nullopt;
      key.add("file", part).add("content", hash_file(part));
    }
    key.add("band", band).add("variable", variable).add("encoding", encoding);
    key.add("source crs", own_crs).add("unit_to_m", unit_to_m).add("max_spike_m", max_spike_m);
    const std::pair<std::string_view, const std::optional<double>*> limits[] = {
        {"nodata", &nodata}, {"lowest_m", &lowest_m}, {"highest_m", &highest_m}};
    for (const auto& [name, limit] : limits)
      if (*limit) key.add(name, **limit);
  }
  return make_cache_key(CachedProduct::elevation, key, subject_of(loaded));
}

Dem read_or_find_dem(const LoadedScene& loaded, const DemParameters& parameters, Progress& progress,
                     const Cache& cache) {
  const std::optional<CacheKey> key =
      cache.is_on() ? elevation_key(loaded, parameters) : std::nullopt;
  return cached<Dem>(
      key ? cache : no_cache(), [&] { return *key; }, progress,
      [&](Progress& watcher) { return read_dem(parameters, watcher); });
}

// Bytes per cell from reading to rays: TerrainModel 69, surface 12, structure of the tracer 23, and
// temporary data of rules and generalization.
constexpr double ground_bytes_per_cell = 160.0;

// Maximum number of cells of a scene's terrain. Automatic limits are powers of the root of two, so
// that machines with nearly the same memory agree.
double max_ground_cells(const SceneTerrain& terrain, double cells) {
  if (terrain.max_mcells > 0.0) return 1e6 * terrain.max_mcells;
  const double fit = static_cast<double>(memory_budget_bytes()) / ground_bytes_per_cell;
  constexpr double share_of_whole = 0.8;
  if (cells <= share_of_whole * fit) return cells;
  constexpr double share_of_windows = 0.5;
  return exact::exp2(0.5 * std::floor(2.0 * exact::log2(std::max(share_of_windows * fit, 1.0))));
}

SceneDem read_scene_dem(const LoadedScene& loaded, Progress& progress, const Cache& cache) {
  const SceneTerrain& terrain = loaded.scene.terrain;
  if (terrain.synthetic)
    return {
        cached<Dem>(
            cache, [&] { return synthetic_key(loaded); }, progress,
            [&](Progress& watcher) { return make_synthetic_terrain(*terrain.synthetic, watcher); }),
        nullptr,
        0.0,
        {}};
  DemParameters parameters = terrain.dem;
  parameters.sources = to_raster_sources(loaded, terrain.sources);
  const RasterFrame frame =
      choose_frame(parameters.sources, parameters.crs, parameters.cell_m, parameters.extent);
  const double cells = static_cast<double>(frame.width) * frame.height;
  const double max = max_ground_cells(terrain, cells);
  const int coarsest = coarsest_level(frame, max);
  if (coarsest == 0)
    return {read_or_find_dem(loaded, parameters, progress, cache), nullptr, 0.0, {}};
  // Even at the coarsest useful resolution it still has to fit.
  const RasterFrame whole_frame = level_frame(frame, coarsest);
  check_memory(
      fmt::format("terrain of {} × {} cells, even in cells of {:g} m", frame.width, frame.height,
                  whole_frame.transform.cell_x),
      reading_bytes(frame) + ground_bytes_per_cell * whole_frame.width * whole_frame.height);
  // A third of the finished ground's memory, released before it is finished.
  auto levels = std::make_shared<DemLevels>(
      parameters, frame, coarsest, max * ground_bytes_per_cell / 3.0 / sizeof(float), progress);
  Dem whole = levels->whole();
  return {std::move(whole), std::move(levels), max, {}};
}

// Stripes are in the cells of the data.
void take_stripes_off(Dem& dem, const LoadedScene& loaded, Progress& progress) {
  if (loaded.scene.generalize.destripe && dem.halved == 0)
    dem.altitude_m = destripe(dem.altitude_m, {}, progress);
}

// The sea in blocks, as in the cells of the whole terrain, so that derived values of a view are the
// same for both.
void level_blocks(Raster<float>& blocks, const SeaParameters& settings, int cells_a_block) {
  const auto known = [](float z) { return !std::isnan(z); };
  if (std::none_of(blocks.cells.begin(), blocks.cells.end(), known)) return;
  Dem dem = make_dem(blocks);
  SeaParameters parameters = settings;
  constexpr int fewest = 16;
  parameters.min_cells = std::max(fewest, parameters.min_cells / (cells_a_block * cells_a_block));
  const Sea sea = find_sea(dem, parameters);
  if (sea.empty()) return;
  level_sea(dem, sea);
  for (std::size_t i = 0; i < blocks.cells.size(); ++i)
    blocks.cells[i] =
        dem.filled[i] != 0 ? std::numeric_limits<float>::quiet_NaN() : dem.altitude_m[i];
}

CoarseAltitudes region_of_data(const SceneDem& opened, const SeaParameters& sea) {
  CoarseAltitudes out = coarse_altitudes_of(opened.dem);
  if (opened.levels) {
    const GeoTransform& cells = opened.levels->frame().transform;
    out = {opened.levels->blocks(), 0.5 * (cells.cell_x + cells.cell_y)};
  }
  level_blocks(out.blocks, sea,
               static_cast<int>(std::lround(out.blocks.transform.cell_x / out.source_cell_m)));
  return out;
}

// The level of a preview. Synthetic terrain, which is small, stays.
void make_preview(SceneDem& opened, const SceneTerrain& terrain) {
  if (terrain.synthetic) return;
  opened.levels.reset();
  const Dem& dem = opened.dem;
  const int level = preview_level({dem.transform, dem.width(), dem.height(), dem.crs},
                                  1e6 * terrain.preview_mcells);
  if (level == 0) return;
  opened.data = std::make_shared<const Dem>(std::move(opened.dem));
  opened.dem = halved_dem(*opened.data, level);
}

}  // namespace

std::vector<RasterSource> to_raster_sources(const LoadedScene& scene,
                                            const std::vector<SceneSource>& sources) {
  std::vector<RasterSource> rasters;
  rasters.reserve(sources.size());
  for (const SceneSource& source : sources) rasters.push_back(to_raster_source(scene, source));
  return rasters;
}

SceneDem open_scene_dem(const LoadedScene& loaded, Progress& progress, const Cache& cache) {
  SceneDem opened = read_scene_dem(loaded, progress, cache);
  // Ground is facets between the centres of cells.
  if (opened.dem.width() < 2 || opened.dem.height() < 2)
    throw Error(ErrorKind::input, "terrain",
                fmt::format("too small: {} × {} cells", opened.dem.width(), opened.dem.height()),
                "at least 2 × 2 cells: a larger `extent`, smaller cells (`cell_m`) or more data");
  // Before stripes are removed and the sea is levelled, which both depend on the cells.
  opened.region = region_of_data(opened, scene_sea(loaded.scene.land_cover));
  Sea sea = prepare_scene_dem(opened.dem, loaded, progress);
  level_scene_lakes(opened.dem, loaded, progress, cache);
  if (!sea.empty())
    progress.note(fmt::format(
        "sea: {:.1f} % of the terrain, at {:.1f} m{}", 100.0 * sea.share, sea.level_m,
        sea.noise_m >= 0.3 ? fmt::format(", levelled from ± {:.1f} m", sea.noise_m) : ""));
  if (opened.levels) opened.sea = std::move(sea);
  if (loaded.scene.terrain.preview_mcells > 0.0) make_preview(opened, loaded.scene.terrain);
  return opened;
}

GroundAltitude ground_altitude_of(const SceneDem& scene) {
  if (scene.data)
    return [&dem = *scene.data](glm::dvec2 position) {
      const glm::dvec2 cell = dem.transform.to_cell(position.x, position.y);
      return static_cast<double>(sample_bilinear(dem.altitude_m, cell.x, cell.y));
    };
  if (!scene.levels) return {};
  return [&scene](glm::dvec2 position) {
    const RasterFrame& frame = scene.levels->frame();
    const glm::dvec2 at =
        glm::clamp(frame.transform.to_cell(position.x, position.y), glm::dvec2(0.0),
                   glm::dvec2(frame.width - 1.0, frame.height - 1.0));
    const int x = std::min(static_cast<int>(at.x), frame.width - 2);
    const int y = std::min(static_cast<int>(at.y), frame.height - 2);
    const Dem cells = scene.levels->window(0, {x, y, x + 2, y + 2}, scene.dem);
    return static_cast<double>(sample_bilinear(cells.altitude_m, at.x - x, at.y - y));
  };
}

Dem make_scene_dem(const LoadedScene& loaded, Progress& progress, const Cache& cache) {
  return make_scene_dem_and_region(loaded, progress, cache).dem;
}

SceneDem make_scene_dem_and_region(const LoadedScene& loaded, Progress& progress,
                                   const Cache& cache) {
  SceneDem opened = open_scene_dem(loaded, progress, cache);
  if (opened.levels)
    progress.note(fmt::format(
        "elevation {} × {} cells is more than memory holds: sampled in cells of {:.0f} m here",
        opened.levels->frame().width, opened.levels->frame().height, opened.dem.cell_m()));
  opened.levels.reset();
  return opened;
}

Sea prepare_scene_dem(Dem& dem, const LoadedScene& loaded, Progress& progress) {
  take_stripes_off(dem, loaded, progress);
  Sea sea = find_sea(dem, scene_sea(loaded.scene.land_cover));
  if (!sea.empty()) level_sea(dem, sea);
  return sea;
}

SeaParameters scene_sea(const SceneLandCover& settings) {
  return {.look = settings.sea != "none", .level_m = settings.sea_level_m};
}

SeaParameters prepare_window_dem(Dem& window, const LoadedScene& loaded, const Dem& whole,
                                 const Sea& whole_sea, const Cache& cache) {
  take_stripes_off(window, loaded, silent_progress());
  SeaParameters sea = scene_sea(loaded.scene.land_cover);
  sea.known = std::make_shared<const Sea>(continue_sea(window, whole, whole_sea, sea));
  level_sea(window, *sea.known);
  level_scene_lakes(window, loaded, silent_progress(), cache, &whole);
  return sea;
}

void add_sea(CacheKeyText& key, const SeaParameters& sea) {
  const auto& [look, level_m, min_cells, found] = sea;
  key.add("sea", look)
      .add("known", level_m.has_value())
      .add("level_m", level_m.value_or(0.0))
      .add("min_cells", min_cells);
  if (found) key.add("sea mask", found->mask).add("sea level_m", found->level_m);
}

void add_dem(CacheKeyText& key, const Dem& dem) {
  const auto& [altitude_m, filled, transform, crs, entries, halved] = dem;
  key.add("halved", halved).add("altitude_m", altitude_m).add("filled", filled).add("crs", crs);
  for (const auto& [x, y, km2] : entries) key.add("entry_x", x).add("entry_y", y).add("km2", km2);
  add_transform(key, transform);
}

namespace {

constexpr double draft_mcells = 2.5;

}  // namespace

GroundSize ground_size_of(const LoadedScene& loaded) {
  const SceneTerrain& terrain = loaded.scene.terrain;
  if (terrain.synthetic) {
    const SyntheticParameters& made = *terrain.synthetic;
    return {1e-6 * made.width * made.height, made.cell_m};
  }
  const RasterFrame frame = choose_frame(to_raster_sources(loaded, terrain.sources),
                                         terrain.dem.crs, terrain.dem.cell_m, terrain.dem.extent);
  return {1e-6 * frame.width * frame.height,
          0.5 * (frame.transform.cell_x + frame.transform.cell_y)};
}

double held_ground_cells(const LoadedScene& loaded) {
  const SceneTerrain& terrain = loaded.scene.terrain;
  const double cells = 1e6 * ground_size_of(loaded).mcells;
  if (terrain.synthetic) return cells;
  const double held = std::min(cells, max_ground_cells(terrain, cells));
  return terrain.preview_mcells > 0.0 ? std::min(held, 1e6 * terrain.preview_mcells) : held;
}

LoadedScene make_draft_scene(LoadedScene loaded) {
  require_scene_files(loaded);
  loaded.scene = make_draft(std::move(loaded.scene));
  loaded.scene.terrain.preview_mcells = draft_mcells;
  return loaded;
}

}  // namespace belvedere
