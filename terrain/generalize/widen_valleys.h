#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "base/grid.h"
#include "base/progress.h"

namespace belvedere {

// Wider valleys, as panorama painters draw them (Patterson 2000 on Berann): the walls move away
// from the centreline of the water, each side by half the width, and leave a flat floor between
// them. The displacement falls to nothing towards the ridges, which keep height and position, so
// walls become slightly steeper.
struct WidenValleysParameters {
  float width_m = 0.F;  // widening of the floors of large valleys; 0 is off; 0…5000
  // Valleys below the minimum catchment are unchanged; from the full one on they get the whole
  // width.
  float min_catchment_km2 = 8.F;    // 0.01…10000
  float full_catchment_km2 = 60.F;  // > min
  float reach_m = 4000.F;           // search radius for the ridges of a valley; 100…20000
  float fade_height = 0.6F;  // share of a valley's depth at which its walls no longer move; 0.1…1
};

struct WidenedValleys {
  Grid<float> altitude_m;
  // Columns and rows from each cell to the source of its ground: land cover, and the altitude that
  // it is painted by, are looked up there. A new floor takes the cover next to the centreline.
  // Empty if nothing moved.
  Grid<glm::vec2> came_from;
  // Columns and rows from each cell of the map to where its lines and names are drawn. They move
  // with the walls; on the floor they stay near the water in proportion to their distance,
  // stretched to at most three times their distances, so that a road along the water is not
  // separated from it. Smooth; 0 at the water and on lakes. Empty if nothing moved.
  Grid<glm::vec2> goes_to;
};

// Cells of `keep` != 0 (lakes) stay; empty: none. `mask`: apply_mask (mask.h), for displacements as
// well, which also fade towards cells of 0; empty: none. Creates no new hollows where it is 1.
// Cells must be finite. Throws Error(usage) for values out of range, Error(bug) if grids differ in
// size.
// halved: number of halvings from the data to these cells (Dem::halved); widths of water and banks
// are in cells of the data.
WidenedValleys widen_valleys(const Grid<float>& altitude_m, const Grid<std::uint8_t>& keep,
                             const Grid<float>& mask, double cell_m,
                             const WidenValleysParameters& parameters, Progress& progress,
                             int halved = 0);

// The displacement of features by widened valleys, in both directions. `goes_to` as in
// WidenedValleys, cells from each cell of the map to where it is drawn; empty: nothing moved.
// Columns and rows, cell centres at whole numbers; extended beyond the grid by its border.

// The drawn cell of a cell of the map.
glm::dvec2 drawn_cell(const Grid<glm::vec2>& goes_to, glm::dvec2 position);
// The cell of the map that is drawn at `drawn`; inverse of drawn_cell() to a hundredth of a cell.
glm::dvec2 origin_cell(const Grid<glm::vec2>& goes_to, glm::dvec2 drawn);

}  // namespace belvedere
