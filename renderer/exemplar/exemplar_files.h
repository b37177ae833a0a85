#pragma once

#include <string>

#include "base/run.h"
#include "renderer/exemplar/coverage.h"
#include "renderer/exemplar/sheet_plan.h"

namespace belvedere {

// A view painted in strokes alone, ready to be copied from: painting.tif and ground.tif (without trees and houses), 16 bit sRGB;
// painting.png; guidance.exr with the channels of paint; scene.toml; coverage.json. Returns what it has to copy from.
Coverage write_scene_exemplar(const LoadedScene& scene, const std::string& out_folder, const Run& run);
// The same of a sheet, panel by panel; sheet.toml instead of scene.toml.
Coverage write_sheet_exemplar(const SheetPlan& plan, const std::string& out_folder, const Run& run);

}  // namespace belvedere
