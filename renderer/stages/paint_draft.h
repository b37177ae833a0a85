#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "renderer/paint/base_picture.h"
#include "texture/strokes/stroke_painter.h"

namespace belvedere {

// The area of each class's paint if the picture were painted in strokes alone: borders of copied
// ground get the shape of strokes.
struct PaintDraft {
  Grid<LandCoverClass> land_cover;  // class of the visible paint
  Grid<glm::vec3> base;             // base colour of the stroke's origin, encoded sRGB
  Grid<std::uint32_t> under;        // of a second class in the same pixel: column (low 16 bits) and
                                    // row of the origin on the sheet …
  Grid<std::uint8_t> under_share;   // … and its share, in 255ths; 0: none
};

// Strokes of the draft: those of copied ground. Standing objects, breaks and sky are painted over
// it later.
inline constexpr StrokeLayers draft_layers{.sky = false, .breaks = false, .upright = false};

// The draft of the pixels that `position` requests; guidance and base picture cover its window,
// which extends stroke_margin_px of the layers around them.
PaintDraft make_paint_draft(const GuidanceBuffers& guidance, const BasePicture& base,
                            const StrokeParameters& strokes, const SheetWindow& position,
                            Progress& progress);

// The draft as a painting of a window of the sheet, for mix_borders: paint from outside the window
// is left out.
Painting to_painting(const PaintDraft& draft, PixelRect window);

}  // namespace belvedere
