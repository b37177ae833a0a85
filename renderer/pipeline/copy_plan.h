#pragma once

#include "base/run.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/sheet/sheet_picture.h"
#include "renderer/sheet/work_folder.h"

namespace belvedere {

// How a scene's ground is copied: its exemplars, and the matches of the sheet as a whole, chosen on a picture of it that is small enough
// (synthesis.plan_mpx). The choice is kept in the work folder, so that a run that goes on, or another machine, need not make it again.
// Classes with too few texels are noted.
CopyPlan make_copy_plan(const LoadedScene& loaded, const World& world, ScenePaint& paint, SheetGround& ground, TileStore::Place& place,
                        const WorkFolder& work, const Run& run);

// What a scene says of synthesis; of a guide that it does not name the default holds.
SynthesisParameters to_synthesis_parameters(const Scene& scene);

// Side of the tiles that the stages of a sheet are made in, px: the larger, the less is made twice at their margins. Error(limit) where not
// even small ones fit the memory. region: the part of the sheet that is made; empty: all of it.
int choose_tile_px(const Scene& scene, double pixels_per_unit, PixelRect region = {}, double beside_bytes = 0.0);

}  // namespace belvedere
