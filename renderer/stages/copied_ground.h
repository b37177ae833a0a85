#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "renderer/features/drawn_features.h"
#include "renderer/mist/mist_paint.h"
#include "renderer/paint/base_picture.h"
#include "renderer/paint/composite.h"
#include "renderer/stages/ground_inputs.h"
#include "renderer/stages/picture_layers.h"
#include "renderer/stages/seam_ground.h"
#include "texture/sheet/synthesis_plan.h"
#include "texture/strokes/stroke_painter.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// The area of each class's paint if the picture were painted in strokes alone: borders of copied
// ground get the shape of strokes.
struct PaintDraft {
  Grid<LandCoverClass> land_cover;  // class of the visible paint
  Grid<glm::vec3> base;             // base colour of the stroke's origin, encoded sRGB
  Grid<std::uint32_t> under;        // of a second class in the same pixel: column (low 16 bits) and
                                    // row of the origin on the sheet
  Grid<std::uint8_t> under_share;   // share of the second class, in 255ths; 0: none
};

// Strokes of the draft: those of copied ground. Standing objects, breaks and sky are painted over
// it later.
inline constexpr StrokeLayers draft_layers{.sky = false, .breaks = false, .upright = false};

// Makes the draft of the pixels that `position` requests; guidance and base picture cover its
// window, which extends stroke_margin_px of the layers around them.
PaintDraft make_paint_draft(const GuidanceBuffers& guidance, const BasePicture& base,
                            const StrokeParameters& strokes, const SheetWindow& position,
                            Progress& progress);

// The draft as a painting of a window of the sheet, for mix_borders: paint from outside the window
// is left out.
Painting to_painting(const PaintDraft& draft, PixelRect window);

// The sources of copied ground, chosen for the sheet as a whole.
struct CopyPlan {
  std::vector<PaintedExemplar> exemplars;
  std::optional<SynthesisPlan> synthesis;
  Residual residual = 0.75;
  GroundModels models;               // of classes that are not copied
  std::optional<SeamSources> seams;  // models that synthesize seams; null: seams stay as copied
  // How far the paintings' water is from the palette's (water_shift); 0 without paintings.
  glm::vec3 water_shift{0.0F};
  std::vector<bool> own_sheets;  // of the exemplars: the program painted it; empty: none
};

// Paint for a window of the sheet: copied texels, and the paint of models and synthesized seams
// that replaces them. All of the window's size; empty where a plan has none.
struct GroundPaint {
  const MatchField& matches;
  const ModelPaint& modelled;
  const SeamPaint& with_seam;
};

// Copied ground of a window, with borders of classes as strokes leave them (mix_borders), encoded
// sRGB. `land_cover`: the class of each pixel. Water that no painting lends its paint is as near to
// the paintings' as the copied ground beside it: 1 - residual of the way.
Grid<glm::vec3> copy_ground(const CopyPlan& plan, const GroundPaint& paint, const PaintDraft& draft,
                            const BasePicture& base, const Grid<LandCoverClass>& land_cover,
                            PixelRect window);

// The paint of a window before its seams are synthesized, in even light.
PaintBeforeSeams make_paint_before_seams(const CopyPlan& plan, const MatchField& matches,
                                         const ModelPaint& modelled,
                                         const Grid<LandCoverClass>& shown, Grid<float> depth_m);

// Finishing paint, which an exemplar cannot provide, laid last over copied ground, far to near:
// mist, sky, trees, houses, roads. Without an exemplar it is everything.

// A window of the sheet and the inputs of finishing paint.
struct FinishingGround {
  const GuidanceBuffers& guidance;  // stroke_channels and tone
  const BasePicture& base;
  const Grid<float>& veil;               // share of mist in front of each pixel, 0…1; empty: none
  const Grid<std::int16_t>& crest_rows;  // CrestShift::rows; empty where the scene has no features
  PixelRect window;                      // of the sheet
};
// The picture below the finishing paint, for the painted pixels.
struct PaintedGround {
  const Grid<glm::vec3>& copied;  // encoded sRGB; empty: the base picture
  const MistPaint& mist;          // empty: none
  PixelRect rect;                 // of the sheet, within the window
};
struct FinishingHand {
  const StrokeParameters& strokes;
  const StrokeLayers& layers;
  const DrawnFeatures& features;
  const IcePlan& ice;
  glm::ivec2 sheet_px;
};

// A finished rectangle before depth edges are softened; and the sources of its layers if requested.
struct FinishedPaint {
  Grid<glm::vec3> picture;  // encoded sRGB
  bool in_parts = false;    // whether the rest is requested
  Grid<glm::vec3> bare;     // the canvas before mist and strokes
  MistPaint mist;
  Grid<float> haze;
  std::optional<PaintParts> parts;
};
FinishedPaint finish_paint(const PaintedGround& painted, const FinishingGround& ground,
                           const FinishingHand& hand, bool in_parts, Progress& progress);

}  // namespace belvedere
