#pragma once

#include <memory>
#include <vector>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/compose/coarse_ground.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/view.h"
#include "terrain/io/dem.h"
#include "terrain/io/dem_levels.h"
#include "terrain/shape/sea.h"

namespace belvedere {

// A scene's DEM. If it has more cells than its ground may have, `dem` is the whole in coarser ones,
// and finer windows are made from the levels; a preview has no windows.
struct SceneDem {
  Dem dem;
  std::shared_ptr<DemLevels> levels;  // null: dem has all cells
  double max_cells = 0.0;             // of the ground with its windows
  Sea sea;                            // of `dem`
  // The data at reduced resolution, with their sea: the same whether `dem` holds them whole or in
  // coarser cells.
  CoarseAltitudes region = {};
  // The cells of the data, for a preview whose `dem` is a coarser level of them; else null.
  std::shared_ptr<const Dem> data = {};
};
// The function for altitudes of the data themselves, for make_view.
GroundAltitude ground_altitude_of(const SceneDem& scene);
SceneDem open_scene_dem(const LoadedScene& scene, Progress& progress,
                        const Cache& cache = no_cache());
// Removes stripes, if the scene asks for it and the cells are those of the data, and levels the
// sea. Returns the sea.
Sea prepare_scene_dem(Dem& dem, const LoadedScene& scene, Progress& progress);
// Prepares a window like prepare_scene_dem, with the sea and the lakes of the whole.
SeaParameters prepare_window_dem(Dem& window, const LoadedScene& scene, const Dem& whole,
                                 const Sea& whole_sea, const Cache& cache = no_cache());

// Makes the DEM of a scene: its sources read and mosaicked, or synthetic terrain; stripes removed
// if the scene asks for it, the sea levelled. Synthetic terrain is cached.
Dem make_scene_dem(const LoadedScene& scene, Progress& progress, const Cache& cache = no_cache());
// Makes the DEM with its reduced copy; if it is larger than memory, as the whole in coarser cells,
// with a note.
SceneDem make_scene_dem_and_region(const LoadedScene& scene, Progress& progress,
                                   const Cache& cache = no_cache());

// A scene's rasters, elevations or classes, with the files found and units in metres.
std::vector<RasterSource> to_raster_sources(const LoadedScene& scene,
                                            const std::vector<SceneSource>& sources);

// The scene's sea settings ([land_cover] sea, sea_level_m); add_sea adds their values to the cache
// key of a dependent result.
SeaParameters scene_sea(const SceneLandCover& settings);
void add_sea(CacheKeyText& key, const SeaParameters& sea);
// Adds the DEM's values to the cache key of a dependent result.
void add_dem(CacheKeyText& key, const Dem& dem);

// Scenes on coarser ground than their data, for previews.

// Cells of a scene's DEM, from the headers of its files. Error(input) where one cannot be read.
struct GroundSize {
  double mcells = 0.0;  // millions
  double cell_m = 0.0;
};
GroundSize ground_size_of(const LoadedScene& loaded);
// Cells that the ground of this scene holds in memory, with its windows; from headers alone.
double held_ground_cells(const LoadedScene& loaded);

// A draft (renderer/scene/scene_settings.h) on ground of about 2.5 million cells at most.
// Error(input) listing all files that are missing.
LoadedScene make_draft_scene(LoadedScene loaded);

}  // namespace belvedere
