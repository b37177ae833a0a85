#pragma once

#include <string>

#include "base/progress.h"
#include "renderer/features/drawn_features.h"
#include "renderer/features/feature_style.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/picture_parameters.h"

namespace belvedere {

// Reads the scene's [[features]], in the terrain's CRS; empty where it has none. Notes what is left
// out and why.
FeatureSet read_scene_features(const LoadedScene& loaded, const std::string& crs,
                               Progress& progress);

// Lays the features on the drawn ground, ready to be painted. Throws as check_extents does.
DrawnFeatures draw_scene_features(const LoadedScene& loaded, const World& world, bool winter,
                                  Progress& progress);

// Whether all of a feature lies outside the terrain.
bool lies_beside(const Feature& feature, const Dem& dem);
// Throws Error(usage) with both extents where nothing of a file lies on the terrain, or in the
// valid area of the terrain's coordinate system: the file then states the wrong one.
void check_extents(const FeatureSet& set, const Dem& dem);

}  // namespace belvedere
