#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

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
#include "terrain/layers/layer_drawing.h"
#include "terrain/shape/catchments.h"
#include "terrain/shape/sea.h"

namespace belvedere {

// What windows of a DEM take from the whole of it.
struct WholeTerrain {
  const Dem& dem;
  const Sea& sea;
  ClassRuleParameters rules;                                  // with its climate, the altitudes that hang on it, and its settlements
  std::optional<Climate> climate = {};                        // of surface layers that ask for one …
  std::shared_ptr<const LazyValue<LayerDrawing>> drawn = {};  // … and how classes are drawn from them
  std::shared_ptr<const MapCover> map = {};                   // areas and rivers, as the whole's ground has them
};
WholeTerrain know_whole(const LoadedScene& scene, const Dem& dem, const Sea& sea);
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
  const SeenFrom* seen = nullptr;    // for guessed rivers
};
WindowCover make_window_cover(const LoadedScene& scene, const WindowGround& window, const WholeTerrain& whole, Progress& progress,
                              const Cache& cache = no_cache());

// The land cover of a scene: from sources and a legend, or by rules. The cache keeps what rules made. `catchments`: the DEM's, for others
// as well. `seen`: for rivers of maps, which are drawn wide enough to be seen.
LandCover make_scene_land_cover(const LoadedScene& scene, const Dem& dem, Progress& progress, const Cache& cache = no_cache(),
                                Catchments* catchments = nullptr, const SeenFrom* seen = nullptr);
// The same, and what became of each class when small patches were taken out ([land_cover] smallest_patch_m2).
PatchResult make_scene_patches(const LoadedScene& scene, const Dem& dem, Progress& progress, const Cache& cache = no_cache(),
                               Catchments* catchments = nullptr, const SeenFrom* seen = nullptr);

}  // namespace belvedere
