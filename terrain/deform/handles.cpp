#include "terrain/deform/handles.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"

namespace belvedere {
namespace {

// Complex numbers as pairs: a position is x + iy.
glm::dvec2 times(glm::dvec2 a, glm::dvec2 b) {
  return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}
glm::dvec2 conjugate(glm::dvec2 a) { return {a.x, -a.y}; }

// If a handle without a radius meets others with one: it dominates closer than this.
constexpr double near_m = 1000.0;

double quintic_smoothstep(double t) { return t * t * t * (10.0 + t * (6.0 * t - 15.0)); }

void check(const std::vector<DeformHandle>& handles) {
  const auto refuse = [](std::size_t i, const std::string& found, const std::string& allowed) {
    throw Error(ErrorKind::usage, fmt::format("handles.{}", i), found, allowed);
  };
  for (std::size_t i = 0; i < handles.size(); ++i) {
    const DeformHandle& h = handles[i];
    for (const double value : {h.centre.x, h.centre.y, h.move_m.x, h.move_m.y, h.rotate_deg,
                               h.scale, h.raise_m, h.radius_m, h.core_m})
      if (!std::isfinite(value)) refuse(i, "a value that is not finite", "finite numbers");
    if (!(h.scale > 0.0)) refuse(i, fmt::format("scale {}", h.scale), "more than 0");
    if (h.radius_m < 0.0 || h.core_m < 0.0) refuse(i, "a negative radius or core", "0 or more");
    if (h.radius_m > 0.0 && h.core_m >= h.radius_m)
      refuse(i, fmt::format("core_m = {} with radius_m = {}", h.core_m, h.radius_m),
             "a core smaller than the radius");
    for (std::size_t k = 0; k < i; ++k) {
      const double apart = glm::length(h.centre - handles[k].centre);
      const double needed = (h.pin ? 0.0 : h.core_m) + (handles[k].pin ? 0.0 : handles[k].core_m);
      if (apart <= needed)
        refuse(i,
               fmt::format("its core and that of handles.{} overlap: the distance is {:.0f} m, the "
                           "sum of the cores {:.0f} m",
                           k, apart, needed),
               "smaller cores or a larger distance");
    }
  }
}

}  // namespace

HandleField::HandleField(std::vector<DeformHandle> handles) : given_(std::move(handles)) {
  check(given_);
  lowest_ = glm::dvec2(std::numeric_limits<double>::infinity());
  highest_ = -lowest_;
  bool any_moves = false;
  for (const DeformHandle& h : given_) {
    Handle& out = handles_.emplace_back();
    const double angle = h.pin ? 0.0 : -to_radians(h.rotate_deg);  // clockwise
    const double scale = h.pin ? 1.0 : h.scale;
    out.centre = h.centre;
    out.image = h.centre + h.move_m;
    out.turn = angle == 0.0 ? glm::dvec2(scale, 0.0)
                            : scale * glm::dvec2(exact::cos(angle), exact::sin(angle));
    out.angle = angle;
    out.log_scale = exact::log(scale);
    out.raise_m = h.raise_m;
    out.radius_m = h.radius_m;
    out.core_m = h.pin ? 0.0 : h.core_m;
    out.pin = h.pin;
    out.still = out.image == out.centre && out.turn == glm::dvec2(1.0, 0.0) && h.raise_m == 0.0;
    any_moves = any_moves || !out.still;
    const double reach = h.radius_m > 0.0 ? h.radius_m : std::numeric_limits<double>::infinity();
    lowest_ = glm::min(lowest_, h.centre - reach);
    highest_ = glm::max(highest_, h.centre + reach);
  }
  if (!any_moves) handles_.clear();
}

HandleField::Moved HandleField::carry(const Handle& handle, glm::dvec2 position) {
  if (handle.still) return {position, 0.0};
  return {handle.image + times(handle.turn, position - handle.centre), handle.raise_m};
}

HandleField::Moved HandleField::move(glm::dvec2 v) const {
  struct Active {
    const Handle* handle;
    double weight;
    double reach2;  // square of the length that weighs its rotation
  };
  constexpr std::size_t max =
      16;  // held without the heap: the maximum number of handles per position in practice
  Active near[max];
  std::vector<Active> more;
  std::size_t count = 0;
  const auto add = [&](const Active& active) {
    if (count < max)
      near[count] = active;
    else
      more.push_back(active);
    ++count;
  };
  const auto each = [&](auto&& f) {
    for (std::size_t i = 0; i < std::min(count, max); ++i) f(near[i]);
    for (Active& active : more) f(active);
  };

  double unlimited = 0.0;
  bool all_still = true;
  for (const Handle& h : handles_) {
    const glm::dvec2 line = v - h.centre;
    const double distance2 = line.x * line.x + line.y * line.y;
    if (h.radius_m > 0.0 && distance2 >= h.radius_m * h.radius_m) continue;
    const double distance = std::sqrt(distance2);
    if (distance <= h.core_m) return carry(h, v);
    double weight = 0.0;
    double reach2 = distance2;
    if (h.radius_m > 0.0) {
      const double share =
          1.0 - quintic_smoothstep((distance - h.core_m) / (h.radius_m - h.core_m));
      if (share >= 1.0) return carry(h, v);
      if (share <= 0.0) continue;
      weight = share / (1.0 - share);
      reach2 = h.radius_m * h.radius_m;
    } else {
      weight = 1.0 / ((distance - h.core_m) * (distance - h.core_m));
      if (!std::isfinite(weight)) return carry(h, v);
      unlimited += weight;
    }
    all_still = all_still && h.still;
    add({&h, weight, reach2});
  }
  if (all_still) return {v, 0.0};

  // Together the handles without a radius weigh at least as much as the fixed ground would, and
  // near each it outweighs all others.
  const double hold = unlimited > 0.0 ? 0.0 : 1.0;
  double weights = 0.0;
  double spread = 0.0;
  glm::dvec2 from(0.0);  // weighted centroids relative to v, of the centres and of their targets
  glm::dvec2 shift(0.0);
  double raise = 0.0;
  each([&](Active& a) {
    if (a.handle->radius_m <= 0.0) a.weight *= 1.0 / unlimited + near_m * near_m;
    weights += a.weight;
    spread += a.weight * a.reach2;
    from += a.weight * (a.handle->centre - v);
    shift += a.weight * (a.handle->image - a.handle->centre);
    raise += a.weight * a.handle->raise_m;
  });
  const double total = weights + hold;
  from /= weights;
  const glm::dvec2 to = from + shift / total;
  const double held = hold / weights;  // share of each handle's weight for keeping its centre
  glm::dvec2 turn(0.0);
  double angle = 0.0;
  double log_scale = 0.0;
  double framed = held * spread;
  each([&](const Active& a) {
    const glm::dvec2 arm = conjugate(a.handle->centre - v - from);
    turn += a.weight * times(arm, a.handle->image - v - to) +
            a.weight * held * times(arm, a.handle->centre - v - to);
    if (a.handle->pin) return;
    angle += a.weight * a.reach2 * a.handle->angle;
    log_scale += a.weight * a.reach2 * a.handle->log_scale;
    framed += a.weight * a.reach2;
  });
  if (framed > 0.0)
    turn += framed * glm::dvec2(exact::cos(angle / framed), exact::sin(angle / framed));
  const double length = exact::hypot(turn.x, turn.y);
  const double scale = framed > 0.0 ? exact::exp(log_scale / framed) : 1.0;
  turn = length > 0.0 ? turn * (scale / length) : glm::dvec2(scale, 0.0);
  return {v + to - times(turn, from), raise / total};
}

}  // namespace belvedere
