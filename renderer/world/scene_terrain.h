#pragma once

#include "base/cache/cache.h"
#include "base/cache/cache_key.h"
#include "base/progress.h"
#include "renderer/scene/scene_file.h"
#include "terrain/cover/land_cover.h"
#include "terrain/cover/land_cover_patches.h"
#include "terrain/io/dem.h"
#include "terrain/shape/sea.h"

namespace belvedere {

// The DEM of a scene: its sources read and mosaicked, or a terrain made up; stripes taken off where the scene asks for it, the sea
// levelled. The cache keeps made-up terrains.
Dem make_scene_dem(const LoadedScene& scene, Progress& progress, const Cache& cache = no_cache());
// Its land cover: from sources and a legend, or by rules. The cache keeps what rules made.
LandCover make_scene_land_cover(const LoadedScene& scene, const Dem& dem, Progress& progress, const Cache& cache = no_cache());
// The same, and what became of each class when small patches were taken out ([land_cover] smallest_patch_m2).
PatchResult make_scene_patches(const LoadedScene& scene, const Dem& dem, Progress& progress, const Cache& cache = no_cache());

// What the scene says of the sea ([land_cover] sea, sea_level_m), and its values in the key of what is made with it.
SeaParameters scene_sea(const SceneLandCover& settings);
void add_sea(CacheKeyText& key, const SeaParameters& sea);

// The DEM's values in the key of what is made from it.
void add_dem(CacheKeyText& key, const Dem& dem);

}  // namespace belvedere
