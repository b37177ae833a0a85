#pragma once

#include <utility>
#include <vector>

#include "terrain/cover/land_cover.h"

namespace belvedere {

// {to, from} of `refine` in [land_cover]: classes that a raster does not distinguish.
using CoverRefinement = std::vector<std::pair<LandCoverClass, LandCoverClass>>;

// Cells of class `from` where the rules give `to` become `to`.
void refine_by_rules(LandCover& cover, const LandCover& rules, const CoverRefinement& refine);

// Inferred rivers where a raster's class may become water, and where it is water; elsewhere their
// width is 0. None if no class may.
std::vector<CoverRiver> refine_rivers(std::vector<CoverRiver> rivers, const LandCover& cover,
                                      const CoverRefinement& refine);

}  // namespace belvedere
