#pragma once

#include <optional>
#include <vector>

#include "renderer/paint/base_picture.h"
#include "renderer/paint/composite.h"
#include "renderer/stages/knit_ground.h"
#include "renderer/stages/model_ground.h"
#include "renderer/stages/paint_draft.h"
#include "texture/sheet/synthesis_plan.h"
#include "texture/synthesis/match_field.h"

namespace belvedere {

// What the ground is copied from, and how it was chosen for the sheet as a whole.
struct CopyPlan {
  std::vector<PaintedExemplar> exemplars;
  std::optional<SynthesisPlan> synthesis;
  double residual = 0.75;           // how much of the base picture's difference is laid over a texel, 0…1
  GroundModels models;              // of classes that are not copied
  std::optional<KnitSources> knit;  // what seams are knitted by; none: they stay as they are copied
};

// Paint that is laid over a window of the sheet: copied texels, and what models and knitted seams put in their place. All of the window's
// size; empty where a plan has none.
struct GroundPaint {
  const MatchField& matches;
  const ModelPaint& modelled;
  const KnitPaint& knitted;
};

// Copied ground of a window, borders of classes as strokes leave them (mix_borders), encoded sRGB. `land_cover`: what stands there.
Grid<glm::vec3> copy_ground(const CopyPlan& plan, const GroundPaint& paint, const PaintDraft& draft, const BasePicture& base,
                            const Grid<LandCoverClass>& land_cover, PixelRect window);

// The same before its seams are knitted, in even light.
UnknitPaint make_unknit_paint(const CopyPlan& plan, const MatchField& matches, const ModelPaint& modelled,
                              const Grid<LandCoverClass>& shown, Grid<float> depth_m);

}  // namespace belvedere
