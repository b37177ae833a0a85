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

Surrounded surround(const Grid<float>& own, const GeoTransform& t, const Dem& whole,
                    double reach_m) {
  // As many cells on each side as the whole has ground for.
  const auto fit = [&](double room_m, double cell_m) {
    return static_cast<int>(std::floor(std::clamp(room_m, 0.0, reach_m) / cell_m + 1e-6));
  };
  const GeoTransform& all = whole.transform;
  Surrounded out;
  out.left = fit(t.origin_x - all.origin_x, t.cell_x);
  out.top = fit(all.origin_y - t.origin_y, t.cell_y);
  const int right = fit(
      all.origin_x + whole.width() * all.cell_x - t.origin_x - own.width() * t.cell_x, t.cell_x);
  const int bottom = fit(
      t.origin_y - own.height() * t.cell_y - all.origin_y + whole.height() * all.cell_y, t.cell_y);
  out.altitude_m = Grid<float>(out.left + own.width() + right, out.top + own.height() + bottom);
  out.transform = {t.origin_x - out.left * t.cell_x, t.origin_y + out.top * t.cell_y, t.cell_x,
                   t.cell_y};
  parallel_rows(out.altitude_m.height(), [&](int y) {
    for (int x = 0; x < out.altitude_m.width(); ++x) {
      if (own.contains(x - out.left, y - out.top)) {
        out.altitude_m(x, y) = own(x - out.left, y - out.top);
        continue;
      }
      const glm::dvec2 position = out.transform.to_crs(x, y);
      const glm::dvec2 cell = all.to_cell(position.x, position.y);
      out.altitude_m(x, y) = sample_bilinear(whole.altitude_m, cell.x, cell.y);
    }
  });
  return out;
}

}  // namespace belvedere
