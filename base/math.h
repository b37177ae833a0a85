#pragma once

#include <concepts>
#include <numbers>

namespace belvedere {

// Small formulas that many stages share. All are plain arithmetic in the type of their arguments,
// so they give the same bits everywhere.

template <std::floating_point T>
constexpr T square(T v) {
  return v * v;
}

// The value clamped to 0…1.
template <std::floating_point T>
constexpr T unit(T v) {
  return v < T{0} ? T{0} : T{1} < v ? T{1} : v;
}

// 3t² - 2t³ with t clamped to 0…1: rises from 0 to 1, with slope 0 at both ends.
template <std::floating_point T>
constexpr T smoothstep(T t) {
  t = unit(t);
  return t * t * (T{3} - T{2} * t);
}

// The same between two values: 0 up to low, 1 from high on; low < high.
template <std::floating_point T>
constexpr T smoothstep(T low, T high, T x) {
  return smoothstep((x - low) / (high - low));
}

// Angles carry their unit in the name: `_deg` in scene files and parameters, `_rad` inside
// formulas.
constexpr double to_radians(double degrees) { return degrees * (std::numbers::pi / 180.0); }
constexpr double to_degrees(double radians) { return radians * (180.0 / std::numbers::pi); }

}  // namespace belvedere
