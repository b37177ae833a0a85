#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "base/guidance_buffers.h"
#include "base/progress.h"
#include "texture/strokes/base_picture.h"
#include "texture/strokes/stroke.h"

namespace belvedere {

// A painting with a bare canvas, encoded sRGB; recorded: as in SheetWindow.
Painting begin_painting(Grid<glm::vec3> canvas, bool recorded = true);

// Paints the strokes in order (ties: as listed) over the canvas. Each tile of the canvas paints the
// strokes that touch it in that order, so the result does not depend on threads and tiles.
// pixels_per_unit: see StrokeParameters. Strokes lie on the sheet; the canvas and the guidance are
// a window of it, of which only requested pixels are painted. `parts`, if given, contains the
// requested pixels and receives the paint.
void paint_in_order(Painting& painting, const GuidanceBuffers& guidance,
                    std::vector<Stroke> strokes, double pixels_per_unit, Progress& progress,
                    const SheetWindow& window = {}, PaintParts* parts = nullptr);

}  // namespace belvedere
