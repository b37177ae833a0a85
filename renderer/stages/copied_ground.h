#pragma once

#include <optional>
#include <vector>

#include "renderer/paint/base_picture.h"
#include "renderer/paint/composite.h"
#include "renderer/stages/model_ground.h"
#include "renderer/stages/paint_draft.h"
#include "renderer/stages/seam_ground.h"
#include "texture/sheet/synthesis_plan.h"
#include "texture/synthesis/match_field.h"

namespace belvedere {

// The sources of copied ground, chosen for the sheet as a whole.
struct CopyPlan {
  std::vector<PaintedExemplar> exemplars;
  std::optional<SynthesisPlan> synthesis;
  double residual = 0.75;  // share of the difference of base pictures applied to a texel, 0…1
  GroundModels models;     // of classes that are not copied
  std::optional<SeamSources> seams;  // models that synthesize seams; null: seams stay as copied
};

// Paint for a window of the sheet: copied texels, and the paint of models and synthesized seams
// that replaces them. All of the window's size; empty where a plan has none.
struct GroundPaint {
  const MatchField& matches;
  const ModelPaint& modelled;
  const SeamPaint& with_seam;
};

// Copied ground of a window, with borders of classes as strokes leave them (mix_borders), encoded
// sRGB. `land_cover`: the class of each pixel.
Grid<glm::vec3> copy_ground(const CopyPlan& plan, const GroundPaint& paint, const PaintDraft& draft,
                            const BasePicture& base, const Grid<LandCoverClass>& land_cover,
                            PixelRect window);

// The same before its seams are synthesized, in even light.
PaintBeforeSeams make_paint_before_seams(const CopyPlan& plan, const MatchField& matches,
                                         const ModelPaint& modelled,
                                         const Grid<LandCoverClass>& shown, Grid<float> depth_m);

}  // namespace belvedere
