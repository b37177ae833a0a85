#include "terrain/register/mountain_deviation.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/math.h"
#include "base/math_exact.h"
#include "terrain/deform/displacement.h"
#include "terrain/register/pair_fit.h"

namespace belvedere {
namespace {

constexpr double mountain_step = 1e-3;  // of a deviation of an unknown

// Mean square of the deviations that the places on a mountain have from its move; 1 at least.
double misfit_of(const DeformHandle& handle, const DisplacementParameters& field) {
  constexpr double max_factor = 25.0;
  double sum = 0.0, count = 0.0;
  for (const DisplacedPlace& place : field.places) {
    const glm::dvec2 line = place.position - handle.centre;
    if (exact::hypot(line.x, line.y) > handle.radius_m) continue;
    sum += 0.5 * (square(place.moved.lateral_m / place.noise.lateral_m) +
                  square(place.moved.upward_m / place.noise.upward_m));
    ++count;
  }
  return count > 0.0 ? std::clamp(sum / count, 1.0, max_factor) : max_factor;
}

}  // namespace

MountainDeviation::MountainDeviation(const Registration& registration)
    : frame_(registration.frame), view_(registration.view), scale_(registration.scale) {
  constexpr std::size_t unknowns = MovedMountain::unknowns;
  const Matrix& all = registration.view_covariance;
  if (all.rows() < view_unknown::count + unknowns * registration.mountains.size()) return;
  for (std::size_t i = 0; i < registration.mountains.size(); ++i) {
    Mountain& out = mountains_.emplace_back();
    out.handle = handle_of(registration.mountains[i]);
    out.factor = misfit_of(out.handle, registration.displacement);
    out.covariance = Matrix(unknowns, unknowns);
    const std::size_t first = view_unknown::count + unknowns * i;
    for (std::size_t k = 0; k < unknowns; ++k) {
      for (std::size_t l = 0; l < unknowns; ++l) out.covariance(k, l) = all(first + k, first + l);
      const auto stepped = [&](double by) {
        MovedMountain mountain = registration.mountains[i];
        mountain.at[k] += by;
        return HandleField({handle_of(mountain)});
      };
      out.ahead.push_back(stepped(mountain_step));
      out.behind.push_back(stepped(-mountain_step));
    }
  }
}

double MountainDeviation::variance_px2(glm::dvec2 position, double altitude_m) const {
  double sum = 0.0;
  for (const Mountain& mountain : mountains_) {
    const glm::dvec2 line = position - mountain.handle.centre;
    if (exact::hypot(line.x, line.y) > mountain.handle.radius_m) continue;
    const auto shown = [&](const HandleField& handles) {
      const HandleField::Moved moved = handles.move(position);
      const ViewPixel at =
          project_in_view(frame_, view_, moved.position, altitude_m + moved.raise_m);
      return glm::dvec2(at.u.value, at.v.value);
    };
    std::array<glm::dvec2, MovedMountain::unknowns> slopes{};
    for (std::size_t k = 0; k < slopes.size(); ++k)
      slopes[k] = (shown(mountain.ahead[k]) - shown(mountain.behind[k])) / (2.0 * mountain_step);
    for (std::size_t k = 0; k < slopes.size(); ++k)
      for (std::size_t l = 0; l < slopes.size(); ++l)
        sum += 0.5 * mountain.factor * mountain.covariance(k, l) *
               (slopes[k].x * slopes[l].x + slopes[k].y * slopes[l].y);
  }
  return square(scale_) * std::max(sum, 0.0);
}

}  // namespace belvedere
