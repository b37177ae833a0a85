#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "renderer/paint/base_picture.h"
#include "texture/strokes/stroke_painter.h"

namespace belvedere {

// Where each class's paint would lie if the picture were painted in strokes alone: borders of copied ground get the shape of strokes.
struct PaintDraft {
  Grid<LandCoverClass> land_cover;  // whose paint shows
  Grid<glm::vec3> base;             // base colour of the place it grew from, encoded sRGB
  Grid<std::uint32_t> under;        // of a second class that shares the pixel: column (low 16 bits) and row of the sheet it grew from …
  Grid<std::uint8_t> under_share;   // … and its share, in 255ths; 0: there is none
};

// Strokes of the draft: of the ground as it is copied. What stands up, breaks or belongs to the sky is painted over it later.
inline constexpr StrokeLayers draft_layers{.sky = false, .breaks = false, .upright = false};

// The draft of the pixels that `place` asks for; guidance and base picture are those of its window, which reaches stroke_margin_px of the
// layers around them.
PaintDraft make_paint_draft(const GuidanceBuffers& guidance, const BasePicture& base, const StrokeParameters& strokes,
                            const SheetWindow& place, Progress& progress);

// The draft as a painting of a window of the sheet, for mix_borders: paint that comes from outside of the window is left out.
Painting to_painting(const PaintDraft& draft, PixelRect window);

}  // namespace belvedere
