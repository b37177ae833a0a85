#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "base/land_cover_class.h"
#include "base/random.h"
#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// A series of strokes on ice longer than a stroke's reach: a line that runs down with the ice, a
// series of crevasses.
struct IceWay {
  Stream stream;                       // of the kind of its strokes
  glm::ivec2 cell{0};                  // cell of its seed: all its random numbers derive from it
  LandCoverClass land_cover;           // class that it runs over
  float strength = 0.F;                // of crevasses: how broken the ice is, 0…1
  float size_units = 0.F;              // of crevasses: length of the longest
  bool is_icefall = false;             // of crevasses: broken into blocks
  std::vector<glm::vec2> positions{};  // units of the sheet, downwards, never empty
  std::vector<float> depth_m{};        // of the ground at each position
  std::vector<glm::vec2> across{};  // what a unit of level ground across the flow measures on the
                                    // sheet at each position, units; empty for flow lines
  std::vector<float> half_width{};  // of moraines at each position, units of ground
  glm::vec2 lowest{0.F}, highest{0.F};  // min and max of the positions' coordinates
};

// The direction of flow of snow and ice in the picture. Ice is thick and stiff: it follows the
// broad slope of its bed, not every hump, so the fall lines of pixels of snow and glacier are
// averaged over about 8 units of the sheet. A cell measures about 4 units.
struct IceFlow {
  Grid<glm::vec2> direction;  // not normalized; 0 where there is no ice; empty: none on the sheet
  float cell_units = 4.F;

  // Unit direction at a position of the sheet in units, straight down where no ice is near.
  glm::vec2 at(glm::vec2 position_units) const;
};
// Finds the flow of ice in a scene that contains the whole sheet.
IceFlow find_ice_flow(const StrokeScene& scene);

// The path of ice downwards from a position, px of the scene's sheet, in steps of step_px, at most
// `steps` of them: it ends where the class or the surface does.
std::vector<glm::vec2> trace_ice(const StrokeScene& scene, const IceFlow& flow, glm::vec2 position,
                                 float step_px, int steps);

// Relative depth difference within one surface of ice, including its humps.
inline constexpr float same_ice_depth = 0.03F;
bool same_ice_surface(const StrokeScene& scene, std::size_t a, std::size_t b);

// Queries of a plan of ice, at positions of the whole sheet, px.

// The path along positions, all of them on the canvas.
IceWay way_along(const StrokeScene& scene, Stream stream, const StrokeSeed& seed,
                 const std::vector<glm::vec2>& positions);

// Whether a position is on a tongue, bare ice between ground without ice, or on the smooth snow
// that feeds it; 0 … 1.
float on_tongue(const StrokeScene& scene, glm::vec2 position);

// The projection on the sheet, in units, of a unit of level ground across the flow, to the right of
// it: short where the ice flows across the picture.
glm::vec2 across_flow(const StrokeScene& scene, glm::vec2 position, glm::vec2 flow);

// Slope of the ice, degrees: a mean along some units of the flow.
float ice_slope_deg(const StrokeScene& scene, const IceFlow& flow, glm::vec2 position);

// Lines of rubble on ice: they begin where ribs of rock divide two streams, widen on their way down
// and join; none begins in firn or ends on open ice.
std::vector<IceWay> plan_moraines(const StrokeScene& scene, const IceFlow& flow, Stream stream);

}  // namespace belvedere
