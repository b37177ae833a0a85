#pragma once

#include <cstdint>

#include "base/grid.h"

namespace belvedere {

// What counts as the floor of a valley: flat, low, and between mountains.
struct ValleyFloorParameters {
  double steepest_deg = 5.5;       // slope after a Gaussian of 60 m
  double above_lowest_m = 70.0;    // at most so much higher than the lowest ground within 900 m
  double below_highest_m = 300.0;  // at least so much lower than the highest ground within 3 km: a plain is no valley
};

// 1 where the ground is a valley's floor. Void (NaN) cells are none.
Grid<std::uint8_t> find_valley_floor(const Grid<float>& altitude_m, double cell_m, const ValleyFloorParameters& parameters = {});

}  // namespace belvedere
