#pragma once

#include <string>
#include <vector>

#include "base/pixel_rect.h"
#include "renderer/world/view.h"
#include "terrain/io/dem.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// How a DEM of more cells than its ground may have is held: the whole in coarse cells, and in it nested windows, each of cells half as
// wide, around what the camera sees finer.
struct GroundWindow {
  int level = 0;      // terrain/io/dem_levels.h
  PixelRect part;     // cells of the level whose ground is traced; begins and ends on cells that the level above has too
  double to_m = 0.0;  // farthest place that is meant to have such cells, from the eye
};
struct GroundPlan {
  int coarsest = 0;                   // level of the whole
  std::vector<GroundWindow> windows;  // the coarsest first; each lies inside the one before
  double cells_per_pixel = 0.0;       // how wide a cell may be against the ground that a pixel shows, at most
};

// Cells around a window's part in which its ground is made as well, so that blurs, bands and searches do not end at the part's edge: three
// standard deviations of the widest relief (1800 m) in cells of 30 m.
constexpr int ground_halo_cells = 192;

// Windows for a view: cells as fine as a quarter of a pixel, or as `most_cells` (halos counted) allow. Ground that the picture does not
// show, a tenth of its width around taken for shown, needs cells of an eighth of its distance: it may still stand before the eye or throw
// shadows. `whole` is the DEM at the coarsest level. Depends on scene and data alone.
GroundPlan plan_ground(const RasterFrame& frame, const Dem& whole, const View& view, double most_cells);

// A line for the user: which cells up to where.
std::string describe(const GroundPlan& plan, const RasterFrame& frame);

}  // namespace belvedere
