#pragma once

#include <glm/vec3.hpp>

#include "base/grid.h"
#include "renderer/features/feature_style.h"

namespace belvedere::tools {

// A kind on a meadow in summer and on snow in winter: a bend of a road, a lift up a slope, three
// houses; at 8 pixels per mm of the sheet, summer left, winter right; encoded sRGB. Empty for kinds
// that change the ground.
Grid<glm::vec3> make_swatch(const FeatureStyle& style, int kind);

}  // namespace belvedere::tools
