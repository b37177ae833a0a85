#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <utility>
#include <vector>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/scene/scene_file.h"
#include "renderer/trace/camera.h"
#include "terrain/cover/land_cover.h"
#include "terrain/cover/map_cover.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"
#include "terrain/shape/hydrology.h"
#include "terrain/shape/river_centrelines.h"

namespace belvedere {

// Rivers of a map, before they are aligned with the valleys of a DEM.
struct MapRivers {
  std::vector<MappedRiver> lines;  // their group is the row of `looks`
  std::vector<CoverRiver> looks;   // class and rank of groups of rivers; without positions
};

// The view in which rivers are drawn.
struct SeenFrom {
  const Camera& camera;
  const Deformation& deformation;
};

// The centrelines in the valleys of this DEM, with the rivers' own widths; cached. Notes how far
// they moved. `catchments`: of the DEM, if available.
std::vector<CoverRiver> lay_rivers(const MapRivers& rivers, const LoadedScene& loaded,
                                   const Dem& dem, Progress& progress,
                                   const Cache& cache = no_cache(),
                                   Catchments* catchments = nullptr);

// The same as drawn in a picture: rivers narrower than min_px are widened, up to three times.
// Inferred rivers that are still too narrow fade instead of breaking into dots; those of maps stay.
struct RiverLook {
  double min_px = 0.0;  // width across the river in the picture
  bool fades = false;
};
CoverRiver widen_for_view(CoverRiver river, const RiverLook& look, const Dem& dem,
                          const SeenFrom& seen);

// Units of the sheet (0.5 mm) in a metre across a river at each of its positions; 0 where the
// camera does not see it. Banks have many positions: every eighth is looked up, between them it is
// linear.
std::vector<double> units_across(const CoverRiver& river, double pixels_per_unit, const Dem& dem,
                                 const SeenFrom& seen);

// {to, from} of `refine` in [land_cover]: classes that a raster does not distinguish.
using CoverRefinement = std::vector<std::pair<LandCoverClass, LandCoverClass>>;

// Cells of class `from` where the rules give `to` become `to`.
void refine_by_rules(LandCover& cover, const LandCover& rules, const CoverRefinement& refine);

// Inferred rivers where a raster's class may become water, and where it is water; elsewhere their
// width is 0. None if no class may.
std::vector<CoverRiver> refine_rivers(std::vector<CoverRiver> rivers, const LandCover& cover,
                                      const CoverRefinement& refine);

// The kind of such strips, none of a style.
constexpr int shore_kind = -2;

// Breadth of the broadest gravel, in units of the sheet.
constexpr double max_shore_units = 3.4;

// Riparian strips of ground along drawn rivers, which the river covers up to its banks: gravel on
// inner banks, groves of trees on outer banks, both with gaps.
struct ShoreParameters {
  std::uint64_t seed = 1;
  // Units of the sheet (0.5 mm) in a metre across river `i` at each of its positions; 0: unseen.
  std::function<std::vector<double>(std::size_t i)> units_per_m;
  // Whether ground at a position, m in the scene's CRS, can have gravel, and trees.
  std::function<bool(glm::dvec2)> is_open;
  std::function<bool(glm::dvec2)> grows_trees;
};

// The strips in the order in which they lie on each other; rivers belong on top of all of them. A
// pure function of the rivers, the seed and what the two functions say.
std::vector<CoverRiver> river_shores(std::span<const CoverRiver> rivers,
                                     const ShoreParameters& parameters);

}  // namespace belvedere
