#pragma once

#include "terrain/climate/zonal_climate.h"

namespace belvedere {

// Where forest ends on level ground that gets rain enough, m; `warmer_k` moves all months. -2000 where trees grow nowhere, 9000 where they
// grow up to there.
double treeline_m(const PlaceClimate& climate, double warmer_k = 0.0, const TreelineParameters& parameters = {});

}  // namespace belvedere
