#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/ground/scene_ground_map.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/lazy_value.h"
#include "terrain/climate/climate.h"
#include "terrain/cover/class_rules.h"
#include "terrain/cover/land_cover.h"
#include "terrain/cover/land_cover_patches.h"
#include "terrain/io/dem.h"
#include "terrain/layers/layer_picture.h"
#include "terrain/shape/hydrology.h"
#include "terrain/shape/sea.h"

namespace belvedere {

// Properties of the whole terrain that windows of its DEM take over.
struct WholeTerrain {
  const Dem& dem;
  const Sea& sea;
  ClassRuleParameters
      rules;  // with its climate, the altitudes that depend on it, and its settlements
  std::optional<Climate> climate = {};                        // for surface layers that need one
  std::shared_ptr<const LazyValue<LayerDrawing>> drawn = {};  // how classes are drawn from layers
  std::shared_ptr<const MapCover> map = {};  // areas and rivers, as on the whole's ground
};
WholeTerrain know_whole(const LoadedScene& scene, const Dem& dem, const Sea& sea);
// Input of class rules around windows, computed on first use: a window from the cache needs none.
struct SeenGround {
  std::shared_ptr<const LazyValue<RuleGround>> ground;
  std::string made_from;  // in the keys of dependent results
};
// Input of class rules from the whole terrain, in a rectangle of its cells: all around the next
// window's halo. Nothing where no rules are used.
std::optional<SeenGround> see_whole(const LoadedScene& scene, const WholeTerrain& whole,
                                    const PixelRect& kept, const Cache& cache = no_cache());
struct WindowCover {
  LandCover cover;
  std::optional<SeenGround> seen;
};
// Input of a window.
struct WindowGround {
  std::shared_ptr<const Dem> dem;  // with its halo
  SeaParameters sea;
  std::shared_ptr<Catchments> catchments;
  PixelRect part;                    // of its cells, the visible part
  PixelRect kept;                    // of its cells, needed by the next window
  std::optional<SeenGround> around;  // the coarser ground
  const SeenFrom* seen = nullptr;    // for inferred rivers
};
WindowCover make_window_cover(const LoadedScene& scene, const WindowGround& window,
                              const WholeTerrain& whole, Progress& progress,
                              const Cache& cache = no_cache());

// Makes the land cover of a scene: from sources and a legend, or by rules, whose result is cached.
// `catchments`: the DEM's, shared. `seen`: for rivers of maps, which are drawn wide enough to be
// visible.
LandCover make_scene_land_cover(const LoadedScene& scene, const Dem& dem, Progress& progress,
                                const Cache& cache = no_cache(), Catchments* catchments = nullptr,
                                const SeenFrom* seen = nullptr);
// Makes the land cover, and reports the change of each class by the removal of small patches
// ([land_cover] smallest_patch_m2).
PatchResult make_scene_patches(const LoadedScene& scene, const Dem& dem, Progress& progress,
                               const Cache& cache = no_cache(), Catchments* catchments = nullptr,
                               const SeenFrom* seen = nullptr);
// The same before the scene's map and rivers are laid over it (lay_ground_map).
PatchResult make_bare_patches(const LoadedScene& loaded, const Dem& dem, Progress& progress,
                              const Cache& cache = no_cache(), Catchments* catchments = nullptr);

}  // namespace belvedere
