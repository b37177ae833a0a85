#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// Which way snow and ice run in the picture. Ice is thick and stiff: it follows the broad fall of its bed, not every hump, so the fall
// lines of pixels of snow and glacier are averaged over about 8 units of the sheet. A cell measures 4 units.
struct IceFlow {
  Grid<glm::vec2> direction;  // not normalized; 0 where there is no ice
  float cell_px = 1.F;
  glm::ivec2 first_cell{0};  // cells are counted from the sheet's corner: which one the grid begins with

  // Unit direction at a place of the sheet, straight down where there is no ice near.
  glm::vec2 at(glm::vec2 place) const;
};
IceFlow find_ice_flow(const StrokeScene& scene);
// How far from a place the ground is that tells the flow there, px.
double ice_flow_reach_px(double pixels_per_unit);

// Lays a stroke of the length along the flow, its middle at `place`, turned aside by aside_rad.
void lay_flow(Stroke& stroke, const IceFlow& flow, glm::vec2 place, float length_px, float aside_rad);

// The way of ice downwards from a place, in steps of step_px, at most `steps` of them: it ends where the class or the surface does.
std::vector<glm::vec2> trace_ice(const StrokeScene& scene, const IceFlow& flow, glm::vec2 place, float step_px, int steps);

}  // namespace belvedere
