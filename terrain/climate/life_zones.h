#pragma once

#include "terrain/climate/zonal_climate.h"

namespace belvedere {

// Altitude of the treeline on level ground with enough rain, m; `warmer_k` shifts all months. -2000
// if trees grow nowhere, 9000 if they grow up to there.
double treeline_m(const PlaceClimate& climate, double warmer_k = 0.0,
                  const TreelineParameters& parameters = {});

}  // namespace belvedere
