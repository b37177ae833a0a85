#pragma once

#include <utility>
#include <vector>

#include "terrain/cover/land_cover.h"

namespace belvedere {

// {to, from} of `refine` in [land_cover]: what a raster does not tell apart.
using CoverRefinement = std::vector<std::pair<LandCoverClass, LandCoverClass>>;

// Cells of class `from` where the rules see `to` become `to`.
void refine_by_rules(LandCover& cover, const LandCover& rules, const CoverRefinement& refine);

// Guessed rivers where a raster's class may become water, and where it is water; elsewhere they have no width. None where nothing may.
std::vector<CoverCourse> refine_rivers(std::vector<CoverCourse> rivers, const LandCover& cover, const CoverRefinement& refine);

}  // namespace belvedere
