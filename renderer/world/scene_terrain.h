#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/cache/cache.h"
#include "base/cache/cache_key.h"
#include "base/progress.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/lazy_value.h"
#include "renderer/world/view.h"
#include "terrain/climate/climate.h"
#include "terrain/cover/class_rules.h"
#include "terrain/cover/land_cover.h"
#include "terrain/cover/land_cover_patches.h"
#include "terrain/io/dem.h"
#include "terrain/io/dem_levels.h"
#include "terrain/layers/layer_drawing.h"
#include "terrain/shape/catchments.h"
#include "terrain/shape/sea.h"

namespace belvedere {

// A scene's DEM. Where it has more cells than its ground may take, `dem` is the whole in coarser ones, and finer windows are made from the
// levels.
struct SceneDem {
  Dem dem;
  std::shared_ptr<DemLevels> levels;  // null: dem is all there is
  double most_cells = 0.0;            // of the ground with its windows
  Sea sea;                            // of `dem`
};
// Altitudes of the data themselves; for make_view.
GroundAltitude ground_altitude_of(const SceneDem& scene);
SceneDem open_scene_dem(const LoadedScene& scene, Progress& progress, const Cache& cache = no_cache());
// Takes off the stripes, where the scene asks for it and the cells are those of the data, and levels the sea. Returns the sea.
Sea prepare_scene_dem(Dem& dem, const LoadedScene& scene, Progress& progress);
// What windows of a DEM take from the whole of it.
struct WholeTerrain {
  const Dem& dem;
  const Sea& sea;
  ClassRuleParameters rules;                                  // with its climate, the altitudes that hang on it, and its settlements
  std::optional<Climate> climate = {};                        // of surface layers that ask for one …
  std::shared_ptr<const LazyValue<LayerDrawing>> drawn = {};  // … and how classes are drawn from them
};
WholeTerrain know_whole(const LoadedScene& scene, const Dem& dem, const Sea& sea);
// A window with the whole's sea, levelled; and its land cover with what the whole knows.
SeaParameters prepare_window_dem(Dem& window, const LoadedScene& scene, const WholeTerrain& whole);
// What class rules saw of a ground that windows lie in, made when a window first asks for it: one from the cache never does.
struct SeenGround {
  std::shared_ptr<const LazyValue<RuleGround>> ground;
  std::string made_from;  // in the keys of what hangs on it
};
// Of the whole, in a rectangle of its cells: all around the next window's halo. Nothing where no rules are asked.
std::optional<SeenGround> see_whole(const LoadedScene& scene, const WholeTerrain& whole, const PixelRect& kept,
                                    const Cache& cache = no_cache());
struct WindowCover {
  LandCover cover;
  std::optional<SeenGround> seen;
};
// What a window is made of.
struct WindowGround {
  std::shared_ptr<const Dem> dem;  // with its halo
  SeaParameters sea;
  std::shared_ptr<Catchments> catchments;
  PixelRect part;                    // of its cells, which is shown
  PixelRect kept;                    // of its cells, that the next window asks for
  std::optional<SeenGround> around;  // the ground before it
};
WindowCover make_window_cover(const LoadedScene& scene, const WindowGround& window, const WholeTerrain& whole, Progress& progress,
                              const Cache& cache = no_cache());

// The DEM of a scene: its sources read and mosaicked, or a terrain made up; stripes taken off where the scene asks for it, the sea
// levelled. The cache keeps made-up terrains.
Dem make_scene_dem(const LoadedScene& scene, Progress& progress, const Cache& cache = no_cache());
// Its land cover: from sources and a legend, or by rules. The cache keeps what rules made. `catchments`: the DEM's, for others as well.
LandCover make_scene_land_cover(const LoadedScene& scene, const Dem& dem, Progress& progress, const Cache& cache = no_cache(),
                                Catchments* catchments = nullptr);
// The same, and what became of each class when small patches were taken out ([land_cover] smallest_patch_m2).
PatchResult make_scene_patches(const LoadedScene& scene, const Dem& dem, Progress& progress, const Cache& cache = no_cache(),
                               Catchments* catchments = nullptr);

// What the scene says of the sea ([land_cover] sea, sea_level_m), and its values in the key of what is made with it.
SeaParameters scene_sea(const SceneLandCover& settings);
void add_sea(CacheKeyText& key, const SeaParameters& sea);

// The DEM's values in the key of what is made from it.
void add_dem(CacheKeyText& key, const Dem& dem);

}  // namespace belvedere
