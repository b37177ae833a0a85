#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/grid.h"
#include "base/land_cover_class.h"
#include "terrain/io/dem.h"
#include "tests/grids.h"

namespace belvedere::test {

// Ground from a formula of metres east and north of the centre, 30 m cells.
inline Dem ground(int size, const std::function<double(double, double)>& altitude) {
  Dem dem;
  dem.altitude_m = Grid<float>(size, size);
  dem.filled = Grid<std::uint8_t>(size, size, 0);
  dem.transform = {1000.0, 5000.0, 30.0, 30.0};
  for (const auto [x, y] : test::cells(size, size))
    dem.altitude_m(x, y) =
        static_cast<float>(altitude(30.0 * (x - size / 2), -30.0 * (y - size / 2)));
  return dem;
}

// A cone of 25° with its summit at the centre.
inline const Dem& cone() {
  static const Dem dem =
      ground(240, [](double e, double n) { return 2900.0 - 0.4663 * std::hypot(e, n); });
  return dem;
}

inline double share(const Grid<LandCoverClass>& classes, LandCoverClass id) {
  return static_cast<double>(std::count(classes.begin(), classes.end(), id)) /
         static_cast<double>(classes.size());
}

}  // namespace belvedere::test
