#pragma once

#include <string>

#include "base/run.h"
#include "renderer/exemplar/available_texels.h"
#include "renderer/exemplar/example_sheet_plan.h"

namespace belvedere {

// Paints a scene's view entirely in strokes and writes it, ready for copying: painting.tif and
// ground.tif (without trees and houses), 16 bit sRGB; painting.png; guidance.exr with the channels
// of paint; scene.toml; coverage.json. Returns its available texels.
AvailableTexels write_scene_exemplar(const LoadedScene& scene, const std::string& out_folder,
                                     const Run& run);
// Writes an example sheet likewise, panel by panel, with sheet.toml instead of scene.toml.
AvailableTexels write_example_sheet(const ExampleSheetPlan& plan, const std::string& out_folder,
                                    const Run& run);

}  // namespace belvedere
