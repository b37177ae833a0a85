#pragma once

#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "base/progress.h"
#include "texture/strokes/base_picture.h"
#include "texture/strokes/sheet_window.h"
#include "texture/strokes/stroke.h"
#include "texture/strokes/stroke_table.h"

namespace belvedere {

// Paints strokes over `canvas` (encoded sRGB), far to near, and returns the painting; the kinds are
// in stroke_table.cpp. Needs the channels depth, land cover, fall line, tone, slope. Throws
// Error(bug) if sizes differ, or if a window without a plan of the sheet's ice needs one. The
// buffers may contain a window of the sheet: pixels at least stroke_margin_px inside the window, or
// at a side where the window ends at the sheet's own border, have the picture, sources, under and
// under_share of the whole, bit for bit (sources and under as indices of the window); `strokes` is
// counted separately in each window. `parts`: as in paint_in_order.
Painting paint_strokes(Grid<glm::vec3> canvas, const GuidanceBuffers& guidance,
                       const BasePicture& base, const StrokeLayers& layers,
                       const StrokeParameters& parameters, Progress& progress,
                       const SheetWindow& window = {}, PaintParts* parts = nullptr);

// Distance around a pixel within which the strokes on it have their inputs, for one kind or for the
// kinds in `layers`, px.
int stroke_margin_px(const StrokeKind& kind, const StrokeParameters& parameters);
int stroke_margin_px(const StrokeLayers& layers, const StrokeParameters& parameters);
// Max distance from its pixel of an index in Painting::sources or under, px along x or y.
int paint_source_reach_px(const StrokeKind& kind, const StrokeParameters& parameters);
int paint_source_reach_px(const StrokeLayers& layers, const StrokeParameters& parameters);

}  // namespace belvedere
