#pragma once

#include <string>

#include "base/run.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {

// The whole main job, top to bottom as named values. Writes guidance.exr, and the panorama in the formats of output.formats.
void render(const LoadedScene& scene, const std::string& out_folder, const Run& run);
// Walks the same way and stops at guidance.exr, band by band, so that memory does not grow with the picture.
void render_guidance(const LoadedScene& scene, const std::string& out_folder, const Run& run);

}  // namespace belvedere
