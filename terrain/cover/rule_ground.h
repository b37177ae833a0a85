#pragma once

#include <cstdint>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "terrain/io/raster.h"

namespace belvedere {

// Variables of class rules on a ground, kept for windows of finer cells in it.
struct RuleGround {
  GeoTransform transform;           // of the grids, which have one size
  std::vector<Grid<float>> inputs;  // by variable; unused ones are empty
  Grid<float>
      ice_km2;  // area of snow field whose ice flows through each cell; empty if rules have no ice
  Grid<float> ice_surface_m;  // surface of the ice
};
// Only of a rectangle of its cells.
RuleGround part_of(RuleGround ground, const PixelRect& cells);

// The ground around a window of finer cells. At the edge of the window's part, variables are those
// of the surrounding ground; from `collar_cells` inwards they are those of the window's own cells.
// Between, the first blend into the second along a ragged line, because the two differ (coarser
// cells are less steep) and must not meet in a straight line. In the halo beyond the part they are
// those of the surrounding ground.
struct RuleAround {
  const RuleGround& ground;  // all around the window's halo
  PixelRect part;            // cells of the window
  int collar_cells = 32;
};

// Weight of the window's own cells, 0…1, at each of width × height cells. `seed`: of the ragged
// line, which depends only on it and on positions.
Grid<float> own_share(const RuleAround& around, const GeoTransform& transform, int width,
                      int height, std::uint64_t seed);

// An input of a window, blended into that of the ground around it.
void join_input(Grid<float>& own, const Grid<float>& around, const Grid<float>& own_share,
                const GeoTransform& transform, const GeoTransform& around_transform);

}  // namespace belvedere
