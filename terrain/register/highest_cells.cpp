#include "terrain/register/highest_cells.h"

#include <algorithm>

namespace belvedere {

Dem highest_cells(const Dem& dem, std::size_t max_cells) {
  int n = 1;
  const auto cells = [&] {
    return static_cast<std::size_t>(dem.width() / n) * static_cast<std::size_t>(dem.height() / n);
  };
  while (cells() > max_cells) ++n;
  if (n == 1) return dem;
  Dem out;
  out.crs = dem.crs;
  out.transform = dem.transform;
  out.transform.cell_x *= n;
  out.transform.cell_y *= n;
  out.altitude_m = Grid<float>(dem.width() / n, dem.height() / n);
  out.filled = Grid<std::uint8_t>(dem.width() / n, dem.height() / n);
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      float highest = dem.altitude_m(n * x, n * y);
      bool filled = true;
      for (int dy = 0; dy < n; ++dy)
        for (int dx = 0; dx < n; ++dx) {
          highest = std::max(highest, dem.altitude_m(n * x + dx, n * y + dy));
          filled = filled && !dem.filled.empty() && dem.filled(n * x + dx, n * y + dy) != 0;
        }
      out.altitude_m(x, y) = highest;
      out.filled(x, y) = filled ? 1 : 0;
    }
  return out;
}

}  // namespace belvedere
