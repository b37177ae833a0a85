#pragma once

#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "base/progress.h"
#include "texture/strokes/base_picture.h"
#include "texture/strokes/stroke.h"
#include "texture/strokes/stroke_table.h"

namespace belvedere {

// Paints strokes over `canvas` (encoded sRGB), far to near, and returns the painting; the kinds are in stroke_table.cpp. Needs the channels
// depth, land cover, fall line, tone, slope. Throws Error(bug) where sizes disagree.
Painting paint_strokes(Grid<glm::vec3> canvas, const GuidanceBuffers& guidance, const BasePicture& base, const StrokeLayers& layers,
                       const StrokeParameters& parameters, Progress& progress);

}  // namespace belvedere
