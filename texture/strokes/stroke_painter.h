#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "base/guidance_buffers.h"
#include "base/progress.h"
#include "texture/strokes/base_picture.h"
#include "texture/strokes/brush.h"
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

// Painters lay fewer, broader strokes on far ranges: planes, not blades of grass. Leaves out some
// strokes and broadens the others, by the air in front of their first pixels. All strokes of one
// tree start at one pixel, so it is kept or left out as a whole; the choice depends on the position
// on the sheet, so that prints of all sizes, and all windows, leave out the same. `origin_px`:
// position of the base picture's (0,0) on the sheet.
std::vector<Stroke> broaden_far(std::vector<Stroke> strokes, const BasePicture& base,
                                glm::ivec2 origin_px, double pixels_per_unit);
// How much farther the broadest of them then reaches, units.
inline constexpr double far_reach_units = 3.6;

}  // namespace belvedere
