#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "texture/strokes/ice/ice_flow.h"
#include "texture/strokes/ice/ice_way.h"
#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// What a plan of ice reads at a position of the whole sheet, px.

// The path along positions, all of them on the canvas.
IceWay way_along(const StrokeScene& scene, Stream stream, const StrokeSeed& seed,
                 const std::vector<glm::vec2>& positions);

// Whether a position is on a tongue, bare ice between ground without ice, or on the smooth snow
// that feeds it; 0 … 1.
float on_tongue(const StrokeScene& scene, glm::vec2 position);

// What a unit of level ground across the flow measures on the sheet, units, to the right of the
// flow: short where the ice flows across the picture.
glm::vec2 across_flow(const StrokeScene& scene, glm::vec2 position, glm::vec2 flow);

// Slope of the ice, degrees: a mean along some units of the flow.
float ice_slope_deg(const StrokeScene& scene, const IceFlow& flow, glm::vec2 position);

// Lines of rubble on ice: they begin where ribs of rock divide two streams, widen on their way down
// and join; none begins in firn or ends on open ice.
std::vector<IceWay> plan_moraines(const StrokeScene& scene, const IceFlow& flow, Stream stream);

}  // namespace belvedere
