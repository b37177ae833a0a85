#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "base/grid.h"
#include "base/progress.h"

namespace belvedere {

// Wider valleys, as panorama painters draw them (Patterson 2000 on Berann): the walls move away from the water's course, each side by
// half the width, and leave a flat floor between them. The move falls to nothing towards the ridges, which keep height and place, so
// walls become a little steeper.
struct WidenValleysParameters {
  float width_m = 0.F;  // how much wider the floors of large valleys become; 0 is off; 0…5000
  // Valleys smaller than the least catchment stay as they are, from the full one on they get the whole width.
  float least_catchment_km2 = 8.F;  // 0.01…10000
  float full_catchment_km2 = 60.F;  // > least
  float reach_m = 4000.F;           // so far off the ridges of a valley are looked for; 100…20000
  float fade_height = 0.6F;         // part of a valley's depth at which its walls no longer move; 0.1…1
};

struct WidenedValleys {
  Grid<float> altitude_m;
  // Columns and rows from each cell to where its ground was before: what lies on the ground (land cover, the altitude that it is painted
  // by) is looked up there. A new floor takes what lies beside the water's course. Empty where nothing moved.
  Grid<glm::vec2> came_from;
  // Columns and rows from each cell of the map to where lines and names that lie there are drawn: with the walls, which keep them; on the
  // floor all the nearer to the water the nearer they were, drawn out to three times their distances at most, so that a road along the
  // water stays one. Smooth; 0 at the water and on lakes. Empty where nothing moved.
  Grid<glm::vec2> goes_to;
};

// Cells of `keep` != 0 (lakes) stay; empty: none. No hollow is left that was not there before. Cells finite.
// Throws Error(usage) for values out of range, Error(bug) where grids differ in size.
WidenedValleys widen_valleys(const Grid<float>& altitude_m, const Grid<std::uint8_t>& keep, double cell_m,
                             const WidenValleysParameters& parameters, Progress& progress);

}  // namespace belvedere
