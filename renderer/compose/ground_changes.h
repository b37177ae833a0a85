#pragma once

#include <vector>

#include "renderer/compose/coarse_ground.h"
#include "terrain/deform/deform.h"

namespace belvedere {

// A coarse ground as a scene would change it before it is raised as a whole and bent. What views are judged by stays the region's: its
// side, relief, plateau and distances to the rim.

// Its valleys wider by so many metres (terrain/generalize/widen_valleys.h); lakes stay.
CoarseGround widened_ground(const CoarseGround& ground, double width_m);

// Its summits raised each by itself.
CoarseGround raised_ground(const CoarseGround& ground, const std::vector<SummitExaggeration>& summits);

}  // namespace belvedere
