#pragma once

#include <string>

#include "base/progress.h"
#include "renderer/features/drawn_features.h"
#include "renderer/features/feature_set.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/picture_parameters.h"

namespace belvedere {

// What the scene's [[features]] hold, in the terrain's CRS; empty where it has none. Notes what is left out and why.
FeatureSet read_scene_features(const LoadedScene& loaded, const std::string& crs, Progress& progress);

// The same laid over the drawn ground, ready to be painted. Throws as check_extents does.
DrawnFeatures draw_scene_features(const LoadedScene& loaded, const World& world, bool winter, Progress& progress);

// Whether all of a feature lies beside the terrain.
bool lies_beside(const Feature& feature, const Dem& dem);
// Throws Error(usage) with both extents where nothing of a file lies on the terrain, or none of its places has one in the terrain's
// coordinate system: its own is then another than it says.
void check_extents(const FeatureSet& set, const Dem& dem);

}  // namespace belvedere
