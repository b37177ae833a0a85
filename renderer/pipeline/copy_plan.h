#pragma once

#include <string>

#include "base/run.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/sheet/work_folder.h"
#include "renderer/stages/stages.h"

namespace belvedere {

// Plans how a scene's ground is copied: its exemplars, and the matches of the sheet as a whole,
// chosen on a reduced picture of it (synthesis.plan_mpx). The plan is kept in the work folder, so
// that a resumed run or another machine need not compute it again. Classes with too few texels are
// noted. ground_tells: whether the stages of `ground` report their progress; otherwise the draft is
// one stage.
CopyPlan make_copy_plan(const LoadedScene& loaded, const World& world, ScenePaint& paint,
                        const GroundStages& ground, TileStore::Place& scratch,
                        const WorkFolder& work, const Run& run, bool ground_tells = true);

// How far the paintings' water is from the palette's, encoded sRGB, the mean over tones: that of
// their own water if they have any, else that of the ground around rivers (valley floor, pasture,
// forest), else of all their classes. 0 without paintings.
glm::vec3 water_shift(const Palette& palette, const std::vector<ScannedPainting>& scans);

// The warning for a print so fine that a sheet painted by the program has too little to copy;
// empty: not needed.
std::string fine_print_note(const Scene& scene);

// Synthesis parameters of a scene; guides that it does not name keep the default.
SynthesisParameters to_synthesis_parameters(const Scene& scene);

// The same, fitted to the exemplars where the scene is silent: the weight of a guide grows with the
// share of the paint's variance that it explains, never below its default, and the neighbourhood
// follows the length of strokes. Noted. Unchanged if the program painted all exemplars.
SynthesisParameters fit_to_paintings(const Scene& scene, const std::vector<Exemplar>& exemplars,
                                     Progress& progress);

}  // namespace belvedere
