#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "base/grid.h"
#include "terrain/cover/land_cover.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"
#include "terrain/shape/hydrology.h"

namespace belvedere {

// Layout of the valley floor, for painting fields and streets. Both grids have the DEM's size.
struct FloorPlan {
  Grid<float> built;  // 0 open land, about .3 a village or the edge of a town … 1 the centre of a
                      // large town
  // Direction of fields and streets: along the nearest river or shore, and along the foot of the
  // slopes. (cos 2a, sin 2a) times the confidence, 0…1; a counterclockwise from east. The angle is
  // doubled because a row that runs east also runs west.
  Grid<glm::vec2> grain;
};

// Settlements are those of the land cover, from any source.
FloorPlan plan_floor(const LandCover& land_cover, const Dem& dem);

struct GroundSurroundings;
struct TerrainWindow;

// All ground values that a pixel may read, made once from the DEM; every grid has the DEM's size.
struct TerrainModel {
  std::shared_ptr<const Dem> dem;  // undeformed, ungeneralized
  Grid<float> generalized_m;       // after generalize()
  Grid<glm::vec2> came_from;    // origin of each cell's ground before valleys were widened, columns
                                // and rows; may be empty
  Grid<glm::vec2> goes_to;      // and where lines and names of each cell are drawn; may be empty
  Grid<float> detail_smooth_m;  // dem after a Gaussian of 60 m: slope and aspect
  Grid<float> shape_smooth_m;   // generalized after a Gaussian of 120 m: normal_smooth, fall line
  Grid<float> relief_s_m, relief_m_m,
      relief_l_m;               // z(30 m) - z(180 m), z(30 m) - z(750 m), z(120 m) - z(1800 m)
  Grid<float> valley_height_m;  // above the lowest ground within 900 m
  Grid<float> rim_m;            // distance to the edge of the known terrain
  Grid<float> flow;             // base-10 logarithm of the upstream area in m²
  std::shared_ptr<const LandCover> land_cover;
  FloorPlan floor_plan;       // how valley floors are laid out
  double exaggeration = 1.0;  // of light's normals
  // Present where the ground is not only exaggerated uniformly: then light's normals are those of
  // the rearranged shape.
  std::optional<Deformation> local;
  double detail_boost = 1.5;  // further exaggeration of normal_detail
  std::vector<TerrainWindow>
      windows;  // of finer cells, as in the surface; Hit::window is their index
};

// Ground in finer cells: see SurfaceWindow. At the edge of its part every value is that of the
// coarser ground; inwards it blends to its own.
struct TerrainWindow {
  TerrainModel ground;  // without windows
  PixelRect part;
  PixelRect replaces;
};

// The ground hit by a ray: column and row of the hit are positions in its grids.
const TerrainModel& ground_of(const TerrainModel& terrain, int window);

// Makes the derived grids from dem, generalized and land cover. Throws Error(bug) where the two
// grids differ in size or land cover has no cells. `catchments`: the DEM's, if they were computed
// before; taken over.
TerrainModel make_terrain_model(std::shared_ptr<const Dem> dem, Grid<float> generalized_m,
                                std::shared_ptr<const LandCover> land_cover, double exaggeration,
                                Catchments* catchments = nullptr);
// The same with known surroundings (ground_surroundings.h).
TerrainModel make_terrain_model(std::shared_ptr<const Dem> dem, Grid<float> generalized_m,
                                std::shared_ptr<const LandCover> land_cover, double exaggeration,
                                GroundSurroundings surroundings);

// Values from the wide surroundings of each position, which take longest to compute for a terrain
// model; fields as there (terrain_model.h). They depend only on elevation and land cover, not on
// the view, so they can be reused between pictures.
struct GroundSurroundings {
  Grid<float> valley_height_m;
  Grid<float> rim_m;
  Grid<float> flow;
  FloorPlan floor_plan;
};

// `catchments`: as for make_terrain_model.
GroundSurroundings find_surroundings(const Dem& dem, const LandCover& land_cover,
                                     Catchments* catchments = nullptr);

// How far every post is from the end of the known terrain, m: by this distance ground fades
// (renderer/paint/terrain_end.h). It is the distance on the ground to the nearest edge of the data,
// plus a lift where a mountain stands far above the whole region: a high body that faded would hang
// as a ghost above nearer, clear ground. The lift falls with the distance from the mountain, but
// more slowly than the distance to the edge grows, so that no ground is nearer to the end than
// ground behind it.
Grid<float> rim_distance(const Dem& dem);

}  // namespace belvedere
