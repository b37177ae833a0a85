#include "renderer/world/scene_terrain.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "renderer/paint/palette.h"
#include "renderer/world/scene_towns.h"
#include "terrain/cover/class_rules.h"
#include "terrain/generalize/destripe.h"

namespace belvedere {
namespace {

constexpr const char* winter_setting = "winter";

RasterSource to_raster_source(const LoadedScene& scene, const SceneSource& source) {
  RasterSource raster = source.raster;
  raster.path = find_scene_file(scene, source.file);
  if (source.unit == "m") raster.unit_to_m = 1.0;
  if (source.unit == "ft") raster.unit_to_m = 0.3048;
  if (source.unit == "us-ft") raster.unit_to_m = 1200.0 / 3937.0;
  return raster;
}

std::vector<RasterSource> to_raster_sources(const LoadedScene& scene, const std::vector<SceneSource>& sources) {
  std::vector<RasterSource> rasters;
  rasters.reserve(sources.size());
  for (const SceneSource& source : sources) rasters.push_back(to_raster_source(scene, source));
  return rasters;
}

LandCover make_rule_cover(const LoadedScene& loaded, const Dem& dem, Progress& progress) {
  const ClassRules rules = read_class_rules(find_named_file(loaded, "layers", loaded.scene.land_cover.rules));
  auto settings = loaded.scene.land_cover.settings;
  // A palette of winter brings its snow along, unless the scene says otherwise or the rules know no winter.
  const auto is_winter = [](const auto& setting) { return setting.first == winter_setting; };
  if (std::none_of(settings.begin(), settings.end(), is_winter) &&
      std::any_of(rules.parameters.begin(), rules.parameters.end(), is_winter) &&
      read_palette(find_named_file(loaded, "palettes", loaded.scene.palette)).winter)
    settings.emplace_back(winter_setting, 1.0);
  return apply_class_rules(
      rules, {.settings = std::move(settings), .towns = make_scene_towns(loaded, dem, progress), .seed = loaded.scene.seed}, dem, progress);
}

// {to, from}: cells of class `from` where the rules see `to` become `to`.
void refine_by_rules(LandCover& cover, const LandCover& rules, const std::vector<std::pair<LandCoverClass, LandCoverClass>>& refine) {
  Grid<LandCoverClass>& cells = cover.classes.cells;
  parallel_rows(cells.height(), [&](int y) {
    for (int x = 0; x < cells.width(); ++x) {
      const glm::dvec2 place = cover.classes.transform.to_crs(x, y);
      const glm::dvec2 at = rules.classes.transform.to_cell(place.x, place.y);
      const LandCoverClass seen = rules.classes.cells.clamped(static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)));
      for (const auto& [to, from] : refine)
        if (cells(x, y) == from && seen == to) {
          cells(x, y) = to;
          break;
        }
    }
  });
}

// With every patch, however small.
LandCover make_full_cover(const LoadedScene& loaded, const Dem& dem, Progress& progress) {
  const SceneLandCover& settings = loaded.scene.land_cover;
  if (settings.sources.empty()) return make_rule_cover(loaded, dem, progress);
  LandCoverParameters parameters;
  parameters.sources = to_raster_sources(loaded, settings.sources);
  parameters.legend = find_named_file(loaded, "legends", settings.legend);
  parameters.folders = loaded.allowed_folders;
  parameters.unknown = settings.unknown;
  parameters.nodata = settings.nodata;
  LandCover cover = read_land_cover(parameters, {dem.transform, dem.width(), dem.height(), dem.crs}, progress);
  if (!settings.refine.empty())
    refine_by_rules(cover, make_rule_cover(loaded, dem, progress), settings.refine);
  else if (!settings.towns.empty() || !settings.towns_file.empty())
    progress.note("the scene's towns are not used: rules build them, and the land cover comes from rasters");
  return cover;
}

Dem read_scene_dem(const LoadedScene& loaded, Progress& progress) {
  const SceneTerrain& terrain = loaded.scene.terrain;
  if (terrain.synthetic) return make_synthetic_terrain(*terrain.synthetic, progress);
  DemParameters parameters = terrain.dem;
  parameters.sources = to_raster_sources(loaded, terrain.sources);
  return read_dem(parameters, progress);
}

}  // namespace

Dem make_scene_dem(const LoadedScene& loaded, Progress& progress) {
  Dem dem = read_scene_dem(loaded, progress);
  if (loaded.scene.generalize.destripe) dem.altitude_m = destripe(dem.altitude_m, {}, progress);
  return dem;
}

LandCover make_scene_land_cover(const LoadedScene& loaded, const Dem& dem, Progress& progress) {
  return make_scene_patches(loaded, dem, progress).cover;
}

PatchResult make_scene_patches(const LoadedScene& loaded, const Dem& dem, Progress& progress) {
  return remove_small_patches(make_full_cover(loaded, dem, progress), loaded.scene.land_cover.patches);
}

}  // namespace belvedere
