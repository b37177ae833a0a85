#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "base/grid.h"
#include "base/land_cover_class.h"
#include "base/pixel_rect.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/terrain_model.h"
#include "renderer/trace/tracer.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"

namespace belvedere {

// A DEM contains only the level of water. Synthetic beds from the banks: below the water they
// continue with the banks' slope and level out with depth.
struct WaterBedParameters {
  double river_width_m = 220.0;  // water that is nowhere wider is a river; > 0
  double deepest_m = 60.0;       // depth at which beds level out, > 0
  double flattest_bank = 0.08;   // minimum rise over run, also for level shores; > 0
  double steepest_bank = 0.60;   // ≥ flattest_bank
};

// For each cell of a DEM; both 0 on land.
struct WaterBeds {
  Grid<float> depth_m;  // of the water, treated as a lake everywhere
  Grid<float> lake;  // 1 on lakes and the sea, 0 on rivers, between where a river flows into a lake
};

// `water`: 1 on water, 0 on land. At distance d from the shore, which is half way between cells of
// water and land, a lake is D (1 - exp(-s d / D)) deep: D the maximum depth, s the slope of the
// bank, the mean over land within 6 cells of the nearest shore. The DEM's altitudes are only read.
// Values depend only on the surroundings within some river widths, so windows of a terrain agree.
WaterBeds make_water_beds(const Grid<std::uint8_t>& water, const Dem& dem,
                          const WaterBedParameters& parameters = {});

// The ground below a terrain's water: beds inferred from the banks, and which water is a lake.
struct WaterGround {
  const TerrainModel* terrain = nullptr;
  WaterBeds beds;  // on the terrain's cells

  struct Place {
    float depth_m = 0.0F;
    float lake = 0.0F;  // 1 lake or sea … 0 river
  };
  // At a position in the scene's CRS on the ground as drawn: content moved by widened valleys is
  // read at its origin.
  Place at(glm::dvec2 position_m) const;
};

// Null if the terrain has no water. The terrain must outlive it. For a terrain with finer windows
// the beds are those of its coarse cells.
std::shared_ptr<const WaterGround> find_water_ground(const TerrainModel& terrain);

// Reflections of level water: for each water pixel the ray through its centre, mirrored at the
// water as drawn (level before the ground was bent, so tilted with it), and its hit.
struct MirrorSight {
  Grid<float> cosine;  // of the angle between the eye's ray and the water's normal, 0…1; 0 where
                       // there is no water
  Grid<float> distance_m;           // from the eye to the water
  Grid<float> path_m;               // from the water to the reflected ground; +inf: the sky
  Grid<float> rise;                 // sine of the elevation angle of the mirrored ray, -1…1
  Grid<LandCoverClass> land_cover;  // of the reflected ground; sky where there is none
  Grid<float> altitude_m;           // of the reflected ground
  Grid<glm::vec3> normal;           // of the reflected ground, for lighting: of the large forms
  Grid<float> shadow;               // 1 where the sun's centre is visible from there, else 0

  int width() const { return cosine.width(); }
  int height() const { return cosine.height(); }
};

struct MirrorParameters {
  glm::dvec3 sun_direction{-0.612, 0.612, 0.5};  // unit; nothing is lit if below the horizon
  double bias_m =
      3.0;  // start of mirrored rays above the water, whose cells are not quite level; 0…100
  int tile_size = 64;  // px, does not change the result
};

// For the pixels of `region`; where `wanted` (of its size) has no mark around, none is traced. Each
// value depends only on its position on the sheet: any region gives the same bits.
MirrorSight trace_mirror(const TerrainModel& terrain, const DeformedSurface& surface,
                         const Deformation& deformation, const Tracer& tracer, const Camera& camera,
                         const MirrorParameters& parameters, const Grid<std::uint8_t>& wanted,
                         PixelRect region);

// Unit normal, in the drawn world, of water that is level at an altitude.
glm::dvec3 water_normal(const Deformation& deformation, glm::dvec3 position);

}  // namespace belvedere
