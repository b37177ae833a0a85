#include "terrain/shape/derivatives.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

// Nine cells in double, z1…z9 from the north-west corner row by row.
struct Window {
  double z1, z2, z3, z4, z5, z6, z7, z8, z9;
};

// Calls f(window) for every cell and stores the result.
template <class F>
Grid<float> map_windows(const Grid<float>& altitude_m, F&& f) {
  const int width = altitude_m.width();
  const int height = altitude_m.height();
  Grid<float> out(width, height);
  parallel_rows(height, [&](int y) {
    const float* north = altitude_m.row(std::max(y - 1, 0));
    const float* here = altitude_m.row(y);
    const float* south = altitude_m.row(std::min(y + 1, height - 1));
    float* target = out.row(y);
    for (int x = 0; x < width; ++x) {
      const int west = std::max(x - 1, 0);
      const int east = std::min(x + 1, width - 1);
      target[x] =
          static_cast<float>(f(Window{north[west], north[x], north[east], here[west], here[x],
                                      here[east], south[west], south[x], south[east]}));
    }
  });
  return out;
}

// Horn's rise towards the east and towards the north, metres per metre.
struct Gradient {
  double east;
  double north;
};

Gradient horn(const Window& w, double cell_x_m, double cell_y_m) {
  return {((w.z3 + 2.0 * w.z6 + w.z9) - (w.z1 + 2.0 * w.z4 + w.z7)) / (8.0 * cell_x_m),
          ((w.z1 + 2.0 * w.z2 + w.z3) - (w.z7 + 2.0 * w.z8 + w.z9)) / (8.0 * cell_y_m)};
}

}  // namespace

Grid<float> slope_deg(const Grid<float>& altitude_m, double cell_x_m, double cell_y_m) {
  return slope_deg(altitude_m, cell_x_m, cell_y_m, {});
}

Grid<float> slope_deg(const Grid<float>& altitude_m, double cell_x_m, double cell_y_m,
                      const SlopeBounds& bounds) {
  // Half a thousandth of a degree wider, so that rounding changes no slope between the bounds.
  constexpr double margin_deg = 0.0005;
  const double low = bounds.low_deg <= 0.0
                         ? -1.0
                         : exact::tan(to_radians(std::max(bounds.low_deg - margin_deg, 0.0)));
  const double high = bounds.high_deg >= 90.0 - margin_deg
                          ? std::numeric_limits<double>::infinity()
                          : exact::tan(to_radians(bounds.high_deg + margin_deg));
  return map_windows(altitude_m, [=](const Window& w) {
    const Gradient g = horn(w, cell_x_m, cell_y_m);
    const double rise = std::sqrt(g.east * g.east + g.north * g.north);
    if (rise < low) return 0.0;
    if (rise > high) return 90.0;
    return to_degrees(exact::atan(rise));
  });
}

Grid<float> relief(const Grid<float>& altitude_m, double cell_m, double inner_m, double outer_m) {
  Grid<float> out = gaussian_blur(altitude_m, inner_m / cell_m);
  const Grid<float> mean = gaussian_blur(altitude_m, outer_m / cell_m);
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) out(x, y) -= mean(x, y);
  });
  return out;
}

Grid<float> height_above_valley(const Grid<float>& altitude_m, double cell_m, double radius_m) {
  const int radius = std::max(1, static_cast<int>(std::lround(radius_m / cell_m)));
  Grid<float> out = window_minimum(gaussian_blur(altitude_m, 1.0), radius);
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) out(x, y) = std::max(0.F, altitude_m(x, y) - out(x, y));
  });
  return out;
}

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
