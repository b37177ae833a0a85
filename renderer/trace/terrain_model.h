#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "base/grid.h"
#include "terrain/cover/floor_plan.h"
#include "terrain/cover/land_cover.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"
#include "terrain/shape/catchments.h"

namespace belvedere {

struct GroundSurroundings;
struct TerrainWindow;

// All the ground values a pixel may ask for, made once from the DEM; every grid has the DEM's size.
struct TerrainModel {
  std::shared_ptr<const Dem> dem;                  // undeformed, ungeneralized
  Grid<float> generalized_m;                       // after generalize()
  Grid<glm::vec2> came_from;                       // where widening of valleys took each cell's ground from, columns and rows; may be empty
  Grid<glm::vec2> goes_to;                         // and where lines and names of each cell are drawn; may be empty
  Grid<float> detail_smooth_m;                     // dem after a Gaussian of 60 m: slope and aspect
  Grid<float> shape_smooth_m;                      // generalized after a Gaussian of 120 m: normal_smooth, fall line
  Grid<float> relief_s_m, relief_m_m, relief_l_m;  // z(30 m) - z(180 m), z(30 m) - z(750 m), z(120 m) - z(1800 m)
  Grid<float> valley_height_m;                     // above the lowest ground within 900 m
  Grid<float> rim_m;                               // distance to where the known terrain ends
  Grid<float> flow;                                // base-10 logarithm of the upstream area in m²
  std::shared_ptr<const LandCover> land_cover;
  FloorPlan floor_plan;       // how valley floors are laid out
  double exaggeration = 1.0;  // of light's normals
  // Given where the ground is not only exaggerated alike everywhere: then light's normals are those of the rearranged shape.
  std::optional<Deformation> local;
  double detail_boost = 1.5;           // further exaggeration of normal_detail
  std::vector<TerrainWindow> windows;  // of finer cells, as those of the surface: Hit::window tells which holds a place
};

// Ground in finer cells: see SurfaceWindow. Where its part begins every value is that of the coarser ground, and becomes its own inwards.
struct TerrainWindow {
  TerrainModel ground;  // without windows
  PixelRect part;
  PixelRect replaces;
};

// The ground that a ray met: column and row of the hit are places of its grids.
const TerrainModel& ground_of(const TerrainModel& terrain, int window);

// Makes the derived grids from dem, generalized and land cover. Throws Error(bug) where the two grids differ in size or land cover has no
// cells. `catchments`: the DEM's, where somebody asked for them before; taken.
TerrainModel make_terrain_model(std::shared_ptr<const Dem> dem, Grid<float> generalized_m, std::shared_ptr<const LandCover> land_cover,
                                double exaggeration, Catchments* catchments = nullptr);
// The same where the surroundings are known (ground_surroundings.h).
TerrainModel make_terrain_model(std::shared_ptr<const Dem> dem, Grid<float> generalized_m, std::shared_ptr<const LandCover> land_cover,
                                double exaggeration, GroundSurroundings surroundings);

}  // namespace belvedere
