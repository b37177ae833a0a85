#pragma once

#include "terrain/io/dem.h"

namespace belvedere {

// How far every post is from the end of the known terrain, m: by this distance ground fades
// (renderer/paint/terrain_end.h). It is the distance on the ground to the nearest edge of the data,
// plus a lift where a mountain stands far above the whole region: a high body that faded would hang
// as a ghost above nearer, clear ground. The lift falls with the distance from the mountain, but
// more slowly than the distance to the edge grows, so that no ground is nearer to the end than
// ground behind it.
Grid<float> rim_distance(const Dem& dem);

}  // namespace belvedere
