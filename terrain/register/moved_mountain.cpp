#include "terrain/register/moved_mountain.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/math_exact.h"

namespace belvedere {

DeformHandle handle_of(const MovedMountain& mountain) {
  constexpr double centre = 0.03, radius = 0.11, radius_spread = 0.35, core = 0.4;
  constexpr double turn_deg = 25.0;
  constexpr double min_radius = 0.04, max_radius = 0.4, max_turn_deg = 170.0;
  // A core that moves by its belt's width / 1.9 folds the belt.
  constexpr double widths_to_fold = 1.9, max_of_fold = 0.95;
  const double extent = mountain.extent_m;
  const auto& x = mountain.at;
  DeformHandle out;
  out.centre = mountain.expected + centre * extent * glm::dvec2(x[0], x[1]);
  out.radius_m =
      extent * std::clamp(radius * exact::exp(std::clamp(radius_spread * x[2], -3.0, 3.0)),
                          min_radius, max_radius);
  out.core_m = core * out.radius_m;
  const double limit = max_of_fold * (out.radius_m - out.core_m) / widths_to_fold;
  const glm::dvec2 wanted = MovedMountain::move * extent * glm::dvec2(x[3], x[4]);
  out.move_m = wanted / std::sqrt(1.0 + (square(wanted.x) + square(wanted.y)) / square(limit));
  out.rotate_deg = std::clamp(turn_deg * x[5], -max_turn_deg, max_turn_deg);
  out.raise_m = MovedMountain::raise * extent * x[6];
  return out;
}

std::vector<DeformHandle> handles_of(std::span<const MovedMountain> mountains) {
  std::vector<DeformHandle> out;
  for (const MovedMountain& mountain : mountains) out.push_back(handle_of(mountain));
  return out;
}

bool are_apart(std::span<const DeformHandle> handles) {
  for (std::size_t i = 0; i < handles.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const glm::dvec2 line = handles[i].centre - handles[k].centre;
      if (exact::hypot(line.x, line.y) <= 1.01 * (handles[i].core_m + handles[k].core_m))
        return false;
    }
  return true;
}

}  // namespace belvedere
