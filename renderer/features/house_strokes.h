#pragma once

#include <vector>

#include "renderer/features/drawn_features.h"
#include "texture/strokes/brush.h"
#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// Houses of the map as strokes, like those of inferred towns: a shadow away from the sun, walls,
// the two sides of a roof, each in its light. Only houses whose foot is inside the scene's buffers.
std::vector<Stroke> house_strokes(const DrawnFeatures& features, const StrokeScene& scene);

}  // namespace belvedere
