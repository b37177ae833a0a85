#pragma once

#include <memory>
#include <vector>

#include "base/cache/cache.h"
#include "base/cache/cache_key.h"
#include "base/progress.h"
#include "renderer/compose/coarse_ground.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/view.h"
#include "terrain/io/dem.h"
#include "terrain/io/dem_levels.h"
#include "terrain/shape/sea.h"

namespace belvedere {

// A scene's DEM. Where it has more cells than its ground may take, `dem` is the whole in coarser ones, and finer windows are made from the
// levels.
struct SceneDem {
  Dem dem;
  std::shared_ptr<DemLevels> levels;  // null: dem is all there is
  double most_cells = 0.0;            // of the ground with its windows
  Sea sea;                            // of `dem`
  // The data from afar, with their sea: the same whether `dem` holds them whole or in coarser cells.
  CoarseAltitudes region = {};
};
// Altitudes of the data themselves; for make_view.
GroundAltitude ground_altitude_of(const SceneDem& scene);
SceneDem open_scene_dem(const LoadedScene& scene, Progress& progress, const Cache& cache = no_cache());
// Takes off the stripes, where the scene asks for it and the cells are those of the data, and levels the sea. Returns the sea.
Sea prepare_scene_dem(Dem& dem, const LoadedScene& scene, Progress& progress);
// The same of a window, with the sea and the lakes of the whole.
SeaParameters prepare_window_dem(Dem& window, const LoadedScene& scene, const Dem& whole, const Sea& whole_sea,
                                 const Cache& cache = no_cache());

// The DEM of a scene: its sources read and mosaicked, or a terrain made up; stripes taken off where the scene asks for it, the sea
// levelled. The cache keeps made-up terrains.
Dem make_scene_dem(const LoadedScene& scene, Progress& progress, const Cache& cache = no_cache());
// With what is known of it from afar; where it is larger than memory, as the whole in coarser cells, and that is noted.
SceneDem make_scene_dem_and_region(const LoadedScene& scene, Progress& progress, const Cache& cache = no_cache());

// A scene's rasters, elevations or classes, with the files found and units in metres.
std::vector<RasterSource> to_raster_sources(const LoadedScene& scene, const std::vector<SceneSource>& sources);

// What the scene says of the sea ([land_cover] sea, sea_level_m), and its values in the key of what is made with it.
SeaParameters scene_sea(const SceneLandCover& settings);
void add_sea(CacheKeyText& key, const SeaParameters& sea);
// The DEM's values in the key of what is made from it.
void add_dem(CacheKeyText& key, const Dem& dem);

}  // namespace belvedere
