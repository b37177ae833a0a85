#pragma once

#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "base/progress.h"
#include "texture/strokes/paint_ground.h"
#include "texture/strokes/stroke.h"

namespace belvedere {

// Which kinds of stroke to paint.
struct StrokeLayers {
  bool sky = true;      // on sky pixels
  bool ground = true;   // wash, rock, meadow, scree, snow, water
  bool accents = true;  // light on edges, dark in hollows
  bool breaks = true;   // how ice runs, breaks and ends: flow lines, moraines, crevasses, edges of glaciers, ribs bare of snow
  bool upright = true;  // what stands on the ground: trees, dwarf pines, houses
};

// Paints strokes over `canvas` (encoded sRGB), far to near, and returns the painting. look/recipe.md, table Strokes. Needs the channels
// depth, land cover, fall line, tone, slope. Throws Error(bug) where sizes disagree.
Painting paint_strokes(Grid<glm::vec3> canvas, const GuidanceBuffers& guidance, const PaintGround& ground, const StrokeLayers& layers,
                       const StrokeParameters& parameters, Progress& progress);

}  // namespace belvedere
