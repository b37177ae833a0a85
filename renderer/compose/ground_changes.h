#pragma once

#include <vector>

#include "renderer/compose/coarse_ground.h"
#include "terrain/deform/deform.h"

namespace belvedere {

// A coarse ground with the changes that a scene makes before it is raised as a whole and bent. The
// reference values of evaluation stay the region's: its side, relief, plateau and distances to the
// rim.

// Its valleys widened by this many metres (terrain/generalize/widen_valleys.h); lakes are
// unchanged.
CoarseGround widened_ground(const CoarseGround& ground, double width_m);

// Its summits raised individually.
CoarseGround raised_ground(const CoarseGround& ground,
                           const std::vector<SummitExaggeration>& summits);

}  // namespace belvedere
