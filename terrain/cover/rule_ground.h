#pragma once

#include <cstdint>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "terrain/io/raster.h"

namespace belvedere {

// What class rules saw of a ground, kept for windows of finer cells that lie in it.
struct RuleGround {
  GeoTransform transform;           // of the grids, which have one size
  std::vector<Grid<float>> inputs;  // by variable; those that no rule asked for are empty
  Grid<float> ice_km2;              // of snow field, whose ice flows through each cell; empty where rules know no ice
  Grid<float> ice_surface_m;        // down which it flows
};
// Of a rectangle of its cells alone.
RuleGround part_of(RuleGround ground, const PixelRect& cells);

// The ground around a window of finer cells. At the edge of the window's part rules see what they saw of that ground, `collar_cells`
// farther in what the window's own cells say; between, the first goes over into the second along a ragged line, so that what the two do not
// agree on (coarser cells are less steep) ends in no straight line. Beyond the part, in the halo, they see what the ground around has.
struct RuleAround {
  const RuleGround& ground;  // all around the window's halo
  PixelRect part;            // cells of the window
  int collar_cells = 32;
};

// How far the window's own cells count, 0…1, at each of width × height cells. `seed`: of the ragged line, which hangs on it and on places.
Grid<float> own_share(const RuleAround& around, const GeoTransform& transform, int width, int height, std::uint64_t seed);

// An input of a window, gone over into that of the ground around it.
void join_input(Grid<float>& own, const Grid<float>& around, const Grid<float>& own_share, const GeoTransform& transform,
                const GeoTransform& around_transform);

}  // namespace belvedere
