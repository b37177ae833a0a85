#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/io/block_means.h"
#include "terrain/io/dem.h"
#include "terrain/io/raster.h"

namespace belvedere {

// A coarse copy of a DEM with the derived grids that a search for views needs. Lengths are relative
// to the region: `side_m` is the side of a square with the area of its data.

struct GroundCell {
  float altitude_m = 0.F;  // voids filled
  float above_m =
      0.F;  // above the valleys around it: the lowest within a tenth of the side, smoothed
  float incision_m = 0.F;  // how far it lies below the uplands on both sides: the ground with its
                           // narrow valleys filled, minus itself
  float rim_m = 0.F;       // to the end of the data; 0 beyond them
  bool known = false;      // inside the data; holes within them count
  bool floor = false;      // of a valley: flat, low, between mountains
  bool water = false;      // level to a few decimetres over a whole lake, or the sea
  bool operator==(const GroundCell&) const = default;
};

struct CoarseGround {
  Grid<GroundCell> cells;
  GeoTransform transform;      // cells are square
  std::string crs;             // metric; WKT2, or empty where the DEM has none
  double cell_m = 0.0;         // of the copy
  double source_cell_m = 0.0;  // of the data
  double side_m = 0.0;
  double void_share = 0.0;  // 0…1 of the frame
  double lowest_m = 0.0;
  double highest_m = 0.0;
  double low_m = 0.0;     // 5 % lie lower
  double upper_m = 0.0;   // 0.1 % lie higher
  double relief_m = 1.0;  // from `low_m` to the altitude that 3 % lie above; > 0
  double plateau = 0.0;  // 0…1: a dissected plateau, whose valleys are narrower than its uplands,
                         // rather than mountains
  // Highest minus lowest ground within a radius: by powers of √2 of a metre, from `first_relief`
  // on.
  std::vector<Grid<float>> local_reliefs_m;
  int first_relief = 0;

  // The cell at a position; null outside.
  const GroundCell* at(glm::dvec2 position) const;
  // Bilinear, borders replicated.
  double altitude_m(glm::dvec2 position) const;
  // For the next power of √2 to the radius.
  const Grid<float>& local_relief_m(double radius_m) const;
};

struct CoarseGroundParameters {
  int max_cells = usual_blocks;  // of the longer side, 64…4096
};

// Reads the ground from the files of a scene, warped to its metric CRS. Throws what read_dem throws
// for unusable files. Error(input) where there are no data.
CoarseGround read_coarse_ground(const DemParameters& dem, Progress& progress,
                                const CoarseGroundParameters& parameters = {});
// The altitudes that a coarse ground is made of.
struct CoarseAltitudes {
  Raster<float> blocks;        // means of whole cells; voids are NaN
  double source_cell_m = 0.0;  // of the data
};
// Reduces a DEM in memory; filled cells count as voids.
CoarseAltitudes coarse_altitudes_of(const Dem& dem, const CoarseGroundParameters& parameters = {});
// `move`: where a point (x, y, altitude) of the ground moves, for ground that is deformed before it
// is measured; empty: no move.
CoarseGround coarse_ground_of(const CoarseAltitudes& altitudes,
                              const std::function<glm::dvec3(glm::dvec3)>& move = {});
// From cells that are coarse already; voids are NaN.
CoarseGround make_coarse_ground(Raster<float> raster, double source_cell_m);

}  // namespace belvedere
