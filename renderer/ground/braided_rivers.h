#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "terrain/cover/map_cover.h"

namespace belvedere {

// On a broad level floor a river is a belt of gravel, on which up to three threads part around bars
// and meet again, every four to eight of its widths.
struct BraidParameters {
  std::uint64_t seed = 1;
  // Units of the sheet (0.5 mm) in a metre across river `i` at each of its positions; 0: unseen.
  std::function<std::vector<double>(std::size_t i)> units_per_m;
  // Whether gravel of a river at `from` may lie at `to`, m in the scene's CRS.
  std::function<bool(glm::dvec2 from, glm::dvec2 to)> is_floor;
};

// The rivers with their belts below them, in the order in which they lie on each other; where one
// is braided its own line has no width. Threads depend on the place alone and lie on the gravel
// wherever it is broader than the river.
std::vector<CoverRiver> braid_rivers(std::span<const CoverRiver> rivers,
                                     const BraidParameters& parameters);

}  // namespace belvedere
