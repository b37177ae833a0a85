#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "renderer/features/drawn_features.h"
#include "renderer/mist/mist_paint.h"
#include "renderer/paint/base_picture.h"
#include "renderer/stages/picture_layers.h"
#include "texture/strokes/stroke_painter.h"

namespace belvedere {

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
// What is below the finishing paint, for the painted pixels.
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
