#pragma once

#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "base/progress.h"
#include "texture/strokes/base_picture.h"
#include "texture/strokes/sheet_window.h"
#include "texture/strokes/stroke.h"
#include "texture/strokes/stroke_table.h"

namespace belvedere {

// Paints strokes over `canvas` (encoded sRGB), far to near, and returns the painting; the kinds are in stroke_table.cpp. Needs the channels
// depth, land cover, fall line, tone, slope. Throws Error(bug) where sizes disagree, and where a window without a plan of the sheet's ice
// shall get strokes that follow it.
// The buffers may hold a window of the sheet: pixels that lie stroke_margin_px or more inside of the window, or whose window ends at the
// sheet's own border, have picture, sources, under and under_share of the whole, bit for bit (sources and under as indices of the window);
// `strokes` is counted in each window anew. `parts`: as paint_in_order's.
Painting paint_strokes(Grid<glm::vec3> canvas, const GuidanceBuffers& guidance, const BasePicture& base, const StrokeLayers& layers,
                       const StrokeParameters& parameters, Progress& progress, const SheetWindow& window = {}, PaintParts* parts = nullptr);

// How far around a pixel the strokes of a kind, or of the kinds in `layers`, take what they paint on it from, px.
int stroke_margin_px(const StrokeKind& kind, const StrokeParameters& parameters);
int stroke_margin_px(const StrokeLayers& layers, const StrokeParameters& parameters);
// How far from its pixel an index of Painting::sources or under may lie, px along x or y.
int paint_source_reach_px(const StrokeKind& kind, const StrokeParameters& parameters);
int paint_source_reach_px(const StrokeLayers& layers, const StrokeParameters& parameters);

}  // namespace belvedere
