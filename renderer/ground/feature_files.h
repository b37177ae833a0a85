#pragma once

#include <vector>

#include "base/progress.h"
#include "renderer/features/feature_style.h"
#include "renderer/scene/scene_file.h"
#include "terrain/io/dem.h"

namespace belvedere {

// The outer edges of a terrain.
MapBox box_of(const Dem& dem);

// The style named in a scene.
FeatureStyle read_scene_feature_style(const LoadedScene& loaded);

// The scene's blocks of features as sources, in their order. A missing file is skipped here;
// callers that need it report it.
std::vector<FeatureSource> feature_sources(const LoadedScene& loaded);

// Features of a scene's files that become ground, only from blocks that can contain such. Features
// outside the terrain are only counted and noted. Throws Error(usage) with both extents if all of a
// file lies outside the terrain: its coordinate system is then probably wrong.
FeatureSet read_ground_features(const LoadedScene& loaded, const FeatureStyle& style,
                                const Dem& dem, Progress& progress);

}  // namespace belvedere
