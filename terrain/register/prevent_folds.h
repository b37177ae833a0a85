#pragma once

#include <cstddef>
#include <vector>

#include "terrain/register/pair_fit.h"

namespace belvedere {

// A painter stretches and squeezes the ground, but does not lay it over itself. Where the field
// would leave less than a fifth of the area that the handles of mountains leave, or let the ground
// fall by more than 0.8 m a metre away from the viewer, the place near by that agrees least with
// the others gets less weight until it does not; a sure pair only if there is no other. Sets the
// field's places by that. Returns the indices of the places with less weight, ascending.
std::vector<std::size_t> prevent_folds(PairFit& fit, double sigma_px);

}  // namespace belvedere
