#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/land_cover_class.h"
#include "terrain/cover/land_cover.h"

namespace belvedere {

// Average distance that a step moves the border of a class back.
inline constexpr double cover_erosion_step_m = 50.0;

// Classes to erode and by how many steps: melted snow, cut forest. In this order, each from the
// result of the previous one.
using CoverErosion = std::vector<std::pair<LandCoverClass, int>>;

// Land cover with eroded classes (base/masks/erosion.h), layer by layer, with ragged borders that
// depend on the position on the ground and not on cells. The surrounding class takes their place.
// Water, settlements and unknown cells neither spread nor start erosion, so shores and the edges of
// villages stay. Cells larger than 100 m lose at least half a cell per step. Metric CRS.
LandCover erode_land_cover(LandCover cover, const CoverErosion& erosion, std::uint64_t seed);

}  // namespace belvedere
