#pragma once

#include <glm/vec3.hpp>

#include "base/grid.h"

namespace belvedere {

// Distances whose silhouettes lie where the painting has them: a jump of distance moves across its
// line, by at most radius_px pixels, to the strongest edge of the paint (encoded sRGB) that follows
// it there. Where no edge stands out, it stays. All grids of one size; radius_px 0: known exactly.
Grid<float> snap_silhouettes(Grid<float> depth_m, const Grid<glm::vec3>& painting,
                             const Grid<float>& radius_px);

}  // namespace belvedere
