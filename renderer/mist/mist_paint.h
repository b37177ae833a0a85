#pragma once

#include <glm/vec3.hpp>

#include "base/grid.h"
#include "base/progress.h"
#include "renderer/mist/mist_sight.h"
#include "renderer/paint/air_parameters.h"
#include "renderer/paint/palette.h"
#include "texture/strokes/base_picture.h"
#include "texture/strokes/sheet_window.h"

namespace belvedere {

// Mist as it is painted: what it hides of the picture behind it, and in which colour.
struct MistPaint {
  Grid<float> share;       // 0…1
  Grid<glm::vec3> colour;  // encoded sRGB; 0 where the share is 0
};

// Colour of mist in a light of 0…1 that lies so far away: the palette's clouds, warm where they are lit and cool and blue in the shade,
// seen through its air. Encoded sRGB.
glm::vec3 mist_colour(const AirParameters& air, const Palette& palette, float light, double depth_m, double altitude_m);

// Paints what is seen of mist in soft dabs along its heaps, and its edges with the same brush. `sight` is a window of the sheet (see
// SheetWindow); the result has the size of the pixels asked for.
MistPaint paint_mist(const MistSight& sight, const AirParameters& air, const Palette& palette, const StrokeParameters& strokes,
                     const SheetWindow& window, Progress& progress);
// Lays it over pixels of a picture, encoded sRGB, that begin at `at`.
void lay_mist(Grid<glm::vec3>& picture, glm::ivec2 at, const MistPaint& paint);
// Pixels around those asked for that the window must hold, where the sheet has them.
int mist_margin_px(const StrokeParameters& strokes);

}  // namespace belvedere
