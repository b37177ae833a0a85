#pragma once

#include <cstdint>

#include "base/grid.h"

namespace belvedere {

// Criteria of a valley floor: flat, low, and between mountains.
struct ValleyFloorParameters {
  double steepest_deg = 5.5;     // slope after a Gaussian of 60 m
  double above_lowest_m = 70.0;  // maximum height above the lowest ground within 900 m
  double below_highest_m =
      300.0;  // minimum depth below the highest ground within 3 km: a plain is not a valley
};

// 1 on valley floors. Void (NaN) cells are 0.
Grid<std::uint8_t> find_valley_floor(const Grid<float>& altitude_m, double cell_m,
                                     const ValleyFloorParameters& parameters = {});

}  // namespace belvedere
