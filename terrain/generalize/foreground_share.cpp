#include "terrain/generalize/foreground_share.h"

namespace belvedere {

double foreground_share(double distance, double foreground_to, double background_from) {
  constexpr double rounding = 0.125;                // of the span, inside each of its ends
  constexpr double slope = 1.0 / (1.0 - rounding);  // of the line between the corners
  const double t = (distance - foreground_to) / (background_from - foreground_to);
  // Position along a corner: its parabola rises with slope 0 at the start and `slope` at the end.
  const auto corner = [](double along) { return slope * along * along / (2.0 * rounding); };
  if (t <= 0.0) return 1.0;
  if (t < rounding) return 1.0 - corner(t);
  if (t <= 1.0 - rounding) return 0.5 - slope * (t - 0.5);
  if (t < 1.0) return corner(1.0 - t);
  return 0.0;
}

}  // namespace belvedere
