#pragma once

#include <string>
#include <vector>

#include "base/run.h"
#include "renderer/scene/scene_lock.h"

namespace belvedere {

// Names of the files that rendering a scene writes.
std::vector<std::string> product_names(const Scene& scene);

// The scene at another width, px, its height in proportion; strokes keep their size on the sheet.
LoadedScene at_width(const LoadedScene& scene, int width_px);

// Renders the unchanged scene into a folder and hashes the products. The picture formats are
// lossless, so all are hashed.
std::vector<LockedProduct> render_and_hash(const LoadedScene& scene, const std::string& out_folder,
                                           const Run& run, bool replace = false);

}  // namespace belvedere
