#pragma once

#include <vector>

#include "terrain/register/pair_fit.h"

namespace belvedere {

// Mountains beside those of the fit that may have been moved as a whole, likeliest first: from each
// place where the ground is displaced most, a handle is fitted to all that is near by, with
// Cauchy's loss, from several radii and turns. The view stays as it is.
std::vector<MovedMountain> propose_mountains(const PairFit& fit);

// Drops mountains of the fit that the others tell as well without, and adds proposed ones as long
// as the others tell all the better for it: their leave-one-out with the freedom of the mountain's
// unknowns must gain e^2.
void move_mountains(WeighedPairs& weighed, double sigma_px);

}  // namespace belvedere
