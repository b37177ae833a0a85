#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/land_cover_class.h"
#include "terrain/cover/land_cover.h"

namespace belvedere {

// How far a step takes the border of a class back, in the mean.
inline constexpr double cover_erosion_step_m = 50.0;

// Classes that draw back and by how many steps: snow that has melted, forest that was cut. In this order, each from what the one before
// left.
using CoverErosion = std::vector<std::pair<LandCoverClass, int>>;

// Land cover whose classes have drawn back (base/erosion.h), layer by layer, with ragged borders that hang on the place on the ground and
// not on cells. The class around takes their place; water, settlements and what is unknown take nothing and open nothing: a shore or a
// village's edge stays. Cells larger than 100 m lose at least half a cell a step. Metric CRS.
LandCover erode_land_cover(LandCover cover, const CoverErosion& erosion, std::uint64_t seed);

}  // namespace belvedere
