#pragma once

#include <vector>

#include "base/progress.h"
#include "renderer/paint/composite.h"
#include "renderer/paint/guides.h"
#include "renderer/world/lit_picture.h"
#include "texture/synthesis/match_field.h"
#include "texture/synthesis/synthesize.h"

namespace belvedere {

// Where each class's paint would lie if the picture were painted in strokes alone: borders of copied ground get the shape of strokes.
struct PaintDraft {
  Painting painting;
  PaintedClasses classes;
};
PaintDraft draft_paint(const World& world, const Palette& palette, const LitPicture& lit, Progress& progress);

// The match field of a picture: which texel of which exemplar each pixel copies. Classes with too few texels are noted.
MatchField match_exemplars(const std::vector<PaintedExemplar>& exemplars, const Scene& scene, const LitPicture& lit,
                           const PaintDraft& draft, Progress& progress);

// The ground in the exemplars' hand: copied texture as a residual over the base picture, mixed along borders. Encoded sRGB.
Grid<glm::vec3> copy_ground(const MatchField& matches, const std::vector<PaintedExemplar>& exemplars, const Scene& scene,
                            const LitPicture& lit, const PaintDraft& draft);

}  // namespace belvedere
