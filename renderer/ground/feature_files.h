#pragma once

#include <vector>

#include "base/progress.h"
#include "renderer/features/feature_set.h"
#include "renderer/scene/scene_file.h"
#include "terrain/io/dem.h"

namespace belvedere {

// The outer edges of a terrain.
MapBox box_of(const Dem& dem);

// The style a scene names.
FeatureStyle read_scene_feature_style(const LoadedScene& loaded);

// What a scene's blocks of features say is read, in their order. A file that is missing is left out here, and said by those who need it.
std::vector<FeatureSource> feature_sources(const LoadedScene& loaded);

// Features of a scene's files that become ground, and of its blocks only those that can hold such. Of what lies beside the terrain only how
// much it is, which is noted. Throws Error(usage) with both extents where all of a file lies beside the terrain: its coordinate system then
// is another than it says.
FeatureSet read_ground_features(const LoadedScene& loaded, const FeatureStyle& style, const Dem& dem, Progress& progress);

}  // namespace belvedere
