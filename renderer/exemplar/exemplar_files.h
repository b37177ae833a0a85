#pragma once

#include "renderer/exemplar/coverage.h"
#include "renderer/exemplar/sheet_plan.h"
#include "renderer/pipeline/pipeline.h"

namespace belvedere {

// The header note of a painting's file that says which of its layers it is, and its value for the one without trees.
inline constexpr const char* exemplar_layer_note = "belvedere:layer";
inline constexpr const char* exemplar_ground_layer = "ground";

// A view painted in strokes alone, ready to be copied from: painting.tif and ground.tif (without trees and houses), 16 bit sRGB;
// painting.png; guidance.exr with the channels of paint; scene.toml; coverage.json. Returns what it has to copy from.
Coverage write_scene_exemplar(const LoadedScene& scene, const RenderOptions& options, Progress& progress);
// The same of a sheet, panel by panel; sheet.toml instead of scene.toml.
Coverage write_sheet_exemplar(const SheetPlan& plan, const RenderOptions& options, Progress& progress);

}  // namespace belvedere
