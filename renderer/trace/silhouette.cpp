#include "renderer/trace/silhouette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

constexpr double strength_per_log = 14.0;
constexpr double surely_less =
    1.0 - 1e-9;  // of ratios: with any rounding, the difference of their logarithms is below 0

// 0 is sky; also outside the picture, where nothing can be predicted.
double inverse_depth(const Grid<float>& depth_m, int x, int y) {
  if (!depth_m.contains(x, y)) return 0.0;
  const double depth = depth_m(x, y);
  return std::isfinite(depth) && depth > 0.0 ? 1.0 / depth : 0.0;
}

// Depth ratio from `here` to the next pixel, predicted by a plane through `before` and `here`, ≥ 1;
// 1 without a plane.
double foretold_from_near(double before, double here) {
  if (before <= here) return 1.0;  // rising towards the viewer, or nothing there
  const double next = 2.0 * here - before;
  // A plane that vanishes before the next pixel explains any depth there.
  return next > 0.0 ? here / next : std::numeric_limits<double>::infinity();
}

// The same from the far side: a plane through `there` and `beyond` continued to the near pixel.
double foretold_from_far(double there, double beyond) {
  if (beyond <= 0.0 || beyond >= there) return 1.0;
  return (2.0 * there - beyond) / there;
}

}  // namespace

Grid<float> find_silhouettes(const Grid<float>& depth_m) {
  struct Step {
    int x;
    int y;
  };
  constexpr std::array<Step, 4> steps{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  Grid<float> silhouette(depth_m.width(), depth_m.height());
  parallel_rows(depth_m.height(), [&](int y) {
    for (int x = 0; x < depth_m.width(); ++x) {
      const double here = inverse_depth(depth_m, x, y);
      if (here <= 0.0) continue;
      double strongest = 0.0;
      for (const auto& [dx, dy] : steps) {
        if (!depth_m.contains(x + dx, y + dy)) continue;
        const double there = inverse_depth(depth_m, x + dx, y + dy);
        if (there >= here) continue;
        if (there <= 0.0) {
          strongest = 1.0;
          continue;
        }
        const double jump = here / there;
        const double near = foretold_from_near(inverse_depth(depth_m, x - dx, y - dy), here);
        const double far = foretold_from_far(there, inverse_depth(depth_m, x + 2 * dx, y + 2 * dy));
        // Logarithms take most of the time: they are skipped where a plane predicts more than there
        // is.
        if (jump < std::max(near, far) * surely_less) continue;
        const double foretold = std::max(exact::log(near), exact::log(far));
        strongest = std::max(strongest, strength_per_log * (exact::log(jump) - foretold));
      }
      silhouette(x, y) = static_cast<float>(std::clamp(strongest, 0.0, 1.0));
    }
  });
  return silhouette;
}

}  // namespace belvedere
