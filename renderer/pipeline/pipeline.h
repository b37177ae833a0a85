#pragma once

#include <string>

#include "base/progress.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {

struct RenderOptions {
  std::string out_folder;
  int threads = 0;     // 0: all
  int tile_size = 32;  // changes no bit of the result
};

// The whole main job: reads top to bottom as named values. Writes panorama.tif, panorama.png, panorama.exr and guidance.exr.
void render(const LoadedScene& scene, const RenderOptions& options, Progress& progress);
// Only guidance.exr, band by band, so that memory does not grow with the picture.
void render_guidance(const LoadedScene& scene, const RenderOptions& options, Progress& progress);

}  // namespace belvedere
