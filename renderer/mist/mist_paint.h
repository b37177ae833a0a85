#pragma once

#include <glm/vec3.hpp>

#include "base/grid.h"
#include "base/progress.h"
#include "renderer/mist/mist_sight.h"
#include "renderer/paint/air.h"
#include "renderer/paint/palette.h"
#include "texture/strokes/base_picture.h"

namespace belvedere {

// Mist as painted: the share of the picture that it hides, and its colour.
struct MistPaint {
  Grid<float> share;       // 0…1
  Grid<glm::vec3> colour;  // encoded sRGB; 0 where the share is 0
};

// Colour of mist at a light of 0…1 and a distance: the palette's clouds, warm where lit and cool
// and blue in the shade, seen through its air. Encoded sRGB.
glm::vec3 mist_colour(const AirParameters& air, const Palette& palette, float light, double depth_m,
                      double altitude_m);

// Paints visible mist in soft dabs along its heaps, and its edges with the same brush. `sight` is a
// window of the sheet (see SheetWindow); the result has the size of the requested pixels.
MistPaint paint_mist(const MistSight& sight, const AirParameters& air, const Palette& palette,
                     const StrokeParameters& strokes, const SheetWindow& window,
                     Progress& progress);
// Lays it over pixels of a picture, encoded sRGB, that begin at `at`.
void lay_mist(Grid<glm::vec3>& picture, glm::ivec2 at, const MistPaint& paint);
// Pixels around the requested ones that the window must contain, where the sheet has them.
int mist_margin_px(const StrokeParameters& strokes);

}  // namespace belvedere
