#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "terrain/deform/handles.h"

namespace belvedere {

// A mountain that the painter moved as a whole, as unknowns of a fit. All unknowns are expected to
// be 0 with a standard deviation of 1, L being the extent of the pairs:
//   centre     0.03 L to the east and north of the expected place
//   radius     0.11 L exp(0.35 x), the core 0.4 of it
//   move       0.03 L to the east and north, up to what folds no ground
//   turn       25°
//   raise      0.005 L
struct MovedMountain {
  static constexpr std::size_t unknowns = 7;  // centre (2), radius, move (2), turn, raise
  static constexpr double move = 0.03, raise = 0.005;
  glm::dvec2 expected{0.0};  // its centre, CRS
  double extent_m = 1.0;     // L
  std::array<double, unknowns> at = {};
};

DeformHandle handle_of(const MovedMountain& mountain);
std::vector<DeformHandle> handles_of(std::span<const MovedMountain> mountains);
// Whether handles may stand side by side: HandleField takes them.
bool are_apart(std::span<const DeformHandle> handles);

}  // namespace belvedere
