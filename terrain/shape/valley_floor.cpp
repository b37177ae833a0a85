#include "terrain/shape/valley_floor.h"

#include <algorithm>
#include <cmath>

#include "base/filter.h"
#include "base/parallel.h"
#include "terrain/shape/derivatives.h"

namespace belvedere {

Grid<std::uint8_t> find_valley_floor(const Grid<float>& altitude_m, double cell_m,
                                     const ValleyFloorParameters& parameters) {
  // Filters spread NaN: voids are replaced by the lowest ground, and are not floor themselves.
  Grid<float> known = altitude_m;
  float lowest = 0.F;
  for (const float z : altitude_m)
    if (!std::isnan(z)) lowest = std::min(lowest, z);
  for (float& z : known)
    if (std::isnan(z)) z = lowest;
  const Grid<float> slope = slope_deg(gaussian_blur(known, 60.0 / cell_m), cell_m, cell_m);
  const Grid<float> above = height_above_valley(known, cell_m, 900.0);
  const Grid<float> highest = window_maximum(known, static_cast<int>(std::lround(3000.0 / cell_m)));
  Grid<std::uint8_t> floor(altitude_m.width(), altitude_m.height(), 0);
  parallel_rows(floor.height(), [&](int y) {
    for (int x = 0; x < floor.width(); ++x) {
      const bool flat = static_cast<double>(slope(x, y)) <= parameters.steepest_deg;
      const bool low = static_cast<double>(above(x, y)) <= parameters.above_lowest_m;
      const bool enclosed =
          static_cast<double>(highest(x, y) - known(x, y)) >= parameters.below_highest_m;
      floor(x, y) = flat && low && enclosed && !std::isnan(altitude_m(x, y)) ? 1 : 0;
    }
  });
  return floor;
}

}  // namespace belvedere
