#pragma once

#include <string>
#include <vector>

#include "base/run.h"
#include "renderer/scene/scene_lock.h"

namespace belvedere {

// Names of the files that rendering makes of a scene.
std::vector<std::string> product_names(const Scene& scene);

// The scene at another width, px, its height in proportion; strokes keep their size on the sheet.
LoadedScene at_width(const LoadedScene& scene, int width_px);

// Renders the scene as it stands into a folder and takes the hashes of what was made. Formats of pictures that are written keep values
// exactly, so all are taken.
std::vector<LockedProduct> render_and_hash(const LoadedScene& scene, const std::string& out_folder, const Run& run);

}  // namespace belvedere
