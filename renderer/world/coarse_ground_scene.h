#pragma once

#include "renderer/scene/scene_file.h"

namespace belvedere {

// Scenes on coarser ground than their data, for previews.

// Cells of a scene's DEM, from the headers of its files. Error(input) where one cannot be read.
struct GroundSize {
  double mcells = 0.0;  // millions
  double cell_m = 0.0;
};
GroundSize ground_size_of(const LoadedScene& loaded);

// A draft (renderer/scene/draft.h) on ground of about 2.5 million cells at most. Error(input)
// listing all files that are missing.
LoadedScene make_draft_scene(LoadedScene loaded);

}  // namespace belvedere
