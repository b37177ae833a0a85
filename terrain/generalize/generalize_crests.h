#pragma once

#include <vector>

#include "base/grid.h"

namespace belvedere {

// Adds the sharpening of high crests to a change: strength · high · clamp(b2 + b3 + .6 b4, 0, 60 m)
// · (1 - .2 (1 - share)) · mask · amplify (see GeneralizeParameters). levels[i] is Gaussian level i
// + 1 of the altitudes; there is at least one. If the DEM was halved `halved` times, levels[i] is
// level `halved` + i of the original: missing bands add nothing. Null: 1.
void add_crests(Grid<float>& change, std::vector<Grid<float>> levels, int halved,
                const Grid<float>* share, const Grid<float>* mask, const Grid<float>* amplify,
                float strength);
// Number of bands that this needs.
constexpr int crest_bands = 4;

}  // namespace belvedere
