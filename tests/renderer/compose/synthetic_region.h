#pragma once

#include <cmath>
#include <functional>

#include "renderer/compose/coarse_ground.h"
#include "renderer/compose/view_shape.h"
#include "terrain/io/crs.h"
#include "tests/grids.h"

namespace belvedere::test {

// Ground by a formula of places in km, east and north of the region's lower left corner: `side_km`
// a side, cells of a 200th.
inline Raster<float> synthetic_raster(
    double side_km, const std::function<double(double east_km, double north_km)>& altitude_m,
    int cells = 200) {
  const double cell_m = side_km * 1000.0 / cells;
  Raster<float> raster{Grid<float>(cells, cells),
                       {600000.0, 5200000.0 + side_km * 1000.0, cell_m, cell_m},
                       normalize_crs("EPSG:32632")};
  for (const auto [x, y] : test::cells(cells, cells)) {
    const glm::dvec2 at = raster.transform.to_crs(x, y);
    raster.cells(x, y) =
        static_cast<float>(altitude_m((at.x - 600000.0) / 1000.0, (at.y - 5200000.0) / 1000.0));
  }
  return raster;
}
inline glm::dvec2 position_km(double east_km, double north_km) {
  return {600000.0 + 1000.0 * east_km, 5200000.0 + 1000.0 * north_km};
}

// A cone of 2000 m over a plain of 500 m (with waves of 4 m, or it would be a lake), in the middle
// of 60 km, and a lesser one beside it.
inline double cone(double e, double n) {
  const double first = 2000.0 - 250.0 * std::hypot(e - 30.0, n - 30.0);
  const double second = 700.0 - 250.0 * std::hypot(e - 14.0, n - 38.0);
  return 500.0 + std::max({4.0 * std::sin(3.0 * e) * std::sin(2.0 * n), first, second});
}
inline CoarseGround cone_region() {
  return make_coarse_ground(synthetic_raster(60.0, cone), 300.0);
}

// An upland of 2000 m, rolling by 25 m, with a canyon 600 m deep and 1.6 km wide from south to
// north that rises northwards.
inline double canyon(double e, double n) {
  const double upland = 2000.0 + 25.0 * std::sin(0.9 * e) * std::cos(0.7 * n) + 6.0 * n;
  const double off = std::abs(e - 20.0 - 0.8 * std::sin(0.4 * n));
  const double floor = 1350.0 + 8.0 * n;
  if (n > 34.0) return upland;
  const double wall = std::clamp((off - 0.3) / 0.5, 0.0, 1.0);
  return floor + wall * (upland - floor);
}
inline CoarseGround canyon_region() {
  return make_coarse_ground(synthetic_raster(40.0, canyon), 200.0);
}

// The sea in the south, a bay that reaches into mountains of 1500 m.
inline double coast(double e, double n) {
  const double bay = 15.0 + 12.0 * std::exp(-std::pow((e - 25.0) / 5.0, 2.0));
  if (n < bay) return 0.0;
  return std::min(1500.0, 260.0 * (n - bay)) *
             (0.75 + 0.25 * std::sin(1.1 * e) * std::sin(0.9 * n)) +
         1.0;
}
inline CoarseGround coast_region() {
  return make_coarse_ground(synthetic_raster(50.0, coast), 250.0);
}

// A chain of peaks from west to east with valleys before and behind it.
inline double chain(double e, double n) {
  const double across = std::exp(-std::pow((n - 30.0) / 6.0, 2.0));
  const double peaks = 1400.0 + 500.0 * std::cos(0.8 * e) + 150.0 * std::cos(2.1 * e);
  const double hills = 250.0 * (1.0 + std::sin(0.9 * e + 0.3 * n) * std::cos(0.8 * n));
  return 600.0 + across * peaks + hills;
}
inline CoarseGround chain_region() {
  return make_coarse_ground(synthetic_raster(60.0, chain), 300.0);
}

// The tangent of the depression of bent level ground, seen from the eye.
inline double depression(const ViewShape& view, double distance_m) {
  return (view.eye_m - view.base_m - view.level_m + view.drop_m(distance_m)) / distance_m;
}

}  // namespace belvedere::test
