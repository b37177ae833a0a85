#pragma once

#include <string>

#include "base/run.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/sheet/work_folder.h"
#include "renderer/stages/stages.h"

namespace belvedere {

// How a scene's ground is copied: its exemplars, and the matches of the sheet as a whole, chosen on a picture of it that is small enough
// (synthesis.plan_mpx). The choice is kept in the work folder, so that a run that goes on, or another machine, need not make it again.
// Classes with too few texels are noted. ground_tells: whether the stages of `ground` tell of themselves; else the draft is one for all.
CopyPlan make_copy_plan(const LoadedScene& loaded, const World& world, ScenePaint& paint, const GroundStages& ground,
                        TileStore::Place& place, const WorkFolder& work, const Run& run, bool ground_tells = true);

// For a print so fine that a sheet painted by the program has too little to copy, in a user's words; empty: it is none.
std::string fine_print_note(const Scene& scene);

// What a scene says of synthesis; of a guide that it does not name the default holds.
SynthesisParameters to_synthesis_parameters(const Scene& scene);

}  // namespace belvedere
