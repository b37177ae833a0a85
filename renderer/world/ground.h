#pragma once

#include "base/progress.h"
#include "renderer/scene/scene_file.h"
#include "renderer/trace/guidance.h"
#include "renderer/world/view.h"
#include "terrain/cover/land_cover_patches.h"
#include "terrain/deform/deform.h"

namespace belvedere {

// The DEM of a scene: its sources read and mosaicked, or a terrain made up.
Dem make_scene_dem(const LoadedScene& scene, Progress& progress);
// Its land cover: from sources and a legend, or by rules.
LandCover make_scene_land_cover(const LoadedScene& scene, const Dem& dem, Progress& progress);

// The same, and what became of each class when small patches were taken out ([land_cover] smallest_patch_m2).
PatchResult make_scene_patches(const LoadedScene& scene, const Dem& dem, Progress& progress);

// The terrain as one view wants it: generalized by distance, exaggerated and bent.
struct Ground {
  Deformation deformation;
  TerrainModel model;
  DeformedSurface surface;
};
Ground make_ground(const LoadedScene& loaded, Dem dem, LandCover land_cover, const View& view, Progress& progress);
// Where handles fold the ground over itself: Error(usage) naming the handle, the place and a way out if that is in the picture, unless the
// scene allows it; a note otherwise.
void check_folds(const Scene& scene, const Ground& ground, const Camera& camera, Progress& progress);

}  // namespace belvedere
