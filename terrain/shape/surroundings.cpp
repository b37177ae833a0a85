#include "terrain/shape/surroundings.h"

#include <algorithm>
#include <cmath>

#include "base/filter.h"
#include "base/parallel.h"

namespace belvedere {

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
