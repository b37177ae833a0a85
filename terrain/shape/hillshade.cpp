#include "terrain/shape/hillshade.h"

#include <algorithm>
#include <cmath>

#include "base/angle.h"
#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {

Grid<std::uint8_t> hillshade(const Grid<float>& altitude_m, double cell_x_m, double cell_y_m,
                             const HillshadeParameters& parameters) {
  const double azimuth = to_radians(parameters.azimuth_deg);
  const double altitude = to_radians(parameters.altitude_deg);
  const double east = exact::sin(azimuth) * exact::cos(altitude);
  const double north = exact::cos(azimuth) * exact::cos(altitude);
  const double up = exact::sin(altitude);
  const double to_slope_x = parameters.exaggeration / (8.0 * cell_x_m);
  const double to_slope_y = parameters.exaggeration / (8.0 * cell_y_m);
  Grid<std::uint8_t> shade(altitude_m.width(), altitude_m.height());
  parallel_rows(shade.height(), [&](int y) {
    for (int x = 0; x < shade.width(); ++x) {
      const auto z = [&](int dx, int dy) {
        return static_cast<double>(altitude_m.clamped(x + dx, y + dy));
      };
      const double gx =
          to_slope_x * (z(1, -1) + 2.0 * z(1, 0) + z(1, 1) - z(-1, -1) - 2.0 * z(-1, 0) - z(-1, 1));
      const double gy = to_slope_y * (z(-1, -1) + 2.0 * z(0, -1) + z(1, -1) - z(-1, 1) -
                                      2.0 * z(0, 1) - z(1, 1));  // northwards
      if (!std::isfinite(gx + gy + altitude_m(x, y))) continue;
      const double lit = (up - gx * east - gy * north) / std::sqrt(1.0 + gx * gx + gy * gy);
      shade(x, y) = static_cast<std::uint8_t>(std::lround(1.0 + 254.0 * std::clamp(lit, 0.0, 1.0)));
    }
  });
  return shade;
}

}  // namespace belvedere
