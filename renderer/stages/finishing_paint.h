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

// What an exemplar cannot give is painted last, far to near, over copied ground: mist, sky, trees, houses, ways; without an exemplar
// everything is.

// A window of the sheet and what finishing paint is laid by.
struct FinishingGround {
  const GuidanceBuffers& guidance;  // stroke_channels and tone
  const BasePicture& base;
  const Grid<float>& veil;               // share of mist before each pixel, 0…1; empty: there is none
  const Grid<std::int16_t>& crest_rows;  // CrestShift::rows; empty where the scene has no features
  PixelRect window;                      // of the sheet
};
// What lies below it, of the pixels that are painted.
struct PaintedGround {
  const Grid<glm::vec3>& copied;  // encoded sRGB; empty: the base picture
  const MistPaint& mist;          // empty: there is none
  PixelRect rect;                 // of the sheet, within the window
};
struct FinishingHand {
  const StrokeParameters& strokes;
  const StrokeLayers& layers;
  const DrawnFeatures& features;
  const IcePlan& ice;
  glm::ivec2 sheet_px;
};

// A finished rectangle, but for its edges of depth; and what its layers are cut from, where these are asked for.
struct FinishedPaint {
  Grid<glm::vec3> picture;  // encoded sRGB
  bool in_parts = false;    // whether the rest is asked for
  Grid<glm::vec3> bare;     // the canvas before mist and strokes
  MistPaint mist;
  Grid<float> haze;
  std::optional<PaintParts> parts;
};
FinishedPaint finish_paint(const PaintedGround& painted, const FinishingGround& ground, const FinishingHand& hand, bool in_parts,
                           Progress& progress);

}  // namespace belvedere
