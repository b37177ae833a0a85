#pragma once

#include <cstddef>
#include <vector>

#include "terrain/register/pair_fit.h"

namespace belvedere {

// A painter stretches and squeezes the ground, but does not lay it over itself. Where the field
// would leave less than a fifth of the area that mountains' handles leave, or let the ground fall
// by more than 0.8 m a metre away from the viewer, the place near by that agrees least with the
// others counts for less, until it does not. The field's places are set by
// that. Returns the indices
// of these places, ascending.
std::vector<std::size_t> prevent_folds(PairFit& fit, double sigma_px);

}  // namespace belvedere
