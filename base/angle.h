#pragma once

#include <numbers>

namespace belvedere {

// Angles carry their unit in the name: `_deg` in scene files and parameters, `_rad` inside
// formulas.
constexpr double to_radians(double degrees) { return degrees * (std::numbers::pi / 180.0); }
constexpr double to_degrees(double radians) { return radians * (180.0 / std::numbers::pi); }

}  // namespace belvedere
