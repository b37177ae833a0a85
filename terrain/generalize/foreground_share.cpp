#include "terrain/generalize/foreground_share.h"

namespace belvedere {

double foreground_share(double distance, double foreground_to, double background_from) {
  constexpr double rounding = 0.125;  // of the span, to both sides of its ends
  const double t = (distance - foreground_to) / (background_from - foreground_to);
  // Position along a corner: its parabola rises with slope 0 at the start and 1 at the end.
  const auto corner = [](double along) { return along * along / (4.0 * rounding); };
  if (t <= -rounding) return 1.0;
  if (t < rounding) return 1.0 - corner(t + rounding);
  if (t <= 1.0 - rounding) return 1.0 - t;
  if (t < 1.0 + rounding) return corner(1.0 + rounding - t);
  return 0.0;
}

}  // namespace belvedere
