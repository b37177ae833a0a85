#pragma once

#include <string>

#include "base/run.h"
#include "renderer/exemplar/example_sheet_plan.h"
#include "renderer/exemplar/texel_supply.h"

namespace belvedere {

// A view painted in strokes alone, ready to be copied from: painting.tif and ground.tif (without trees and houses), 16 bit sRGB;
// painting.png; guidance.exr with the channels of paint; scene.toml; coverage.json. Returns what it has to copy from.
TexelSupply write_scene_exemplar(const LoadedScene& scene, const std::string& out_folder, const Run& run);
// The same of an example sheet, panel by panel; sheet.toml instead of scene.toml.
TexelSupply write_example_sheet(const ExampleSheetPlan& plan, const std::string& out_folder, const Run& run);

}  // namespace belvedere
