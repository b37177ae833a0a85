#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// The direction of flow of snow and ice in the picture. Ice is thick and stiff: it follows the
// broad slope of its bed, not every hump, so the fall lines of pixels of snow and glacier are
// averaged over about 8 units of the sheet. A cell measures about 4 units.
struct IceFlow {
  Grid<glm::vec2> direction;  // not normalized; 0 where there is no ice; empty: none on the sheet
  float cell_units = 4.F;

  // Unit direction at a position of the sheet in units, straight down where no ice is near.
  glm::vec2 at(glm::vec2 position_units) const;
};
// From a scene that contains the whole sheet.
IceFlow find_ice_flow(const StrokeScene& scene);

// The path of ice downwards from a position, px of the scene's sheet, in steps of step_px, at most
// `steps` of them: it ends where the class or the surface does.
std::vector<glm::vec2> trace_ice(const StrokeScene& scene, const IceFlow& flow, glm::vec2 position,
                                 float step_px, int steps);

// Relative depth difference within one surface of ice, including its humps.
inline constexpr float same_ice_depth = 0.03F;
bool same_ice_surface(const StrokeScene& scene, std::size_t a, std::size_t b);

}  // namespace belvedere
