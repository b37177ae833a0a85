#pragma once

#include <string>
#include <vector>

#include "base/cache/cache.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "renderer/ground/laid_rivers.h"
#include "renderer/scene/scene_file.h"
#include "renderer/trace/terrain_model.h"
#include "renderer/world/view.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"
#include "terrain/io/dem_levels.h"
#include "terrain/io/raster_io.h"
#include "terrain/shape/sea.h"

namespace belvedere {

// A DEM with more cells than its ground may have is stored as the whole in coarse cells, and nested
// windows in it, each of cells half as wide, where the camera needs finer ones.
struct GroundWindow {
  int level = 0;      // terrain/io/dem_levels.h
  PixelRect part;     // cells of the level whose ground is traced; begins and ends on cells of the
                      // next coarser level
  double to_m = 0.0;  // farthest position that should have such cells, from the viewer
};
struct GroundPlan {
  int coarsest = 0;                   // level of the whole
  std::vector<GroundWindow> windows;  // the coarsest first; each lies inside the previous one
  double cells_per_pixel = 0.0;  // maximum width of a cell relative to the ground shown by a pixel
};

// Cells around a window's part in which its ground is made as well, so that blurs, bands and
// searches do not end at the part's edge: three standard deviations of the widest relief (1800 m)
// in cells of 30 m.
constexpr int ground_halo_cells = 192;

// Plans the windows for a view: cells as fine as a quarter of a pixel, or as `max_cells` (halos
// counted) allow. Ground outside the picture, whose width is extended by a tenth, needs cells of an
// eighth of its distance: it may still hide ground or cast shadows. `whole` is the DEM at the
// coarsest level. Depends on scene and data alone.
GroundPlan plan_ground(const RasterFrame& frame, const Dem& whole, const View& view,
                       double max_cells);

// A note for the user: the cell sizes and the distance up to which each applies.
std::string describe(const GroundPlan& plan, const RasterFrame& frame);

// Shared inputs of all windows.
struct WindowMaking {
  const LoadedScene& loaded;
  const View& view;
  const Deformation& deformation;
  const Sea& sea;  // of the whole
  DemLevels& levels;
  Progress& progress;
  const Cache& cache;
  const SeenFrom& seen;
};

// Reads each window of the plan with a halo, makes its land cover, generalizes it like the whole,
// and blends it into the coarser ground: the coarser values apply along the edge of its part, its
// own from 32 cells inwards. Entering rivers keep the whole's values; settlements, climate and the
// sea are those of the whole. `terrain` is the whole's.
void add_ground_windows(TerrainModel& terrain, const GroundPlan& plan, const WindowMaking& making);

// The surface of the terrain's generalized ground and its windows, deformed and joined.
DeformedSurface deform_ground(const TerrainModel& terrain, glm::dvec3 origin,
                              const Deformation& deformation);

}  // namespace belvedere
