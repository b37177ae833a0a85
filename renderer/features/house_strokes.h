#pragma once

#include <vector>

#include "renderer/features/drawn_features.h"
#include "texture/strokes/stroke.h"
#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// Houses of the map as strokes, as those of towns that are made up: a shadow away from the sun, walls, the two sides of a roof, each in its
// light. Those whose foot the scene's buffers hold.
std::vector<Stroke> house_strokes(const DrawnFeatures& features, const StrokeScene& scene);

}  // namespace belvedere
