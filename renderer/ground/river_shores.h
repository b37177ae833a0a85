#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "terrain/cover/map_cover.h"

namespace belvedere {

// The kind of such strips, none of a style.
constexpr int shore_kind = -2;

// What grows and lies along a drawn river, as strips of ground that the river itself covers up to
// its banks: gravel on inner banks, groves of trees on outer banks, both with gaps.
struct ShoreParameters {
  std::uint64_t seed = 1;
  // Units of the sheet (0.5 mm) in a metre across river `i` at each of its positions; 0: unseen.
  std::function<std::vector<double>(std::size_t i)> units_per_m;
  // Whether ground at a position, m in the scene's CRS, can have gravel, and trees.
  std::function<bool(glm::dvec2)> is_open;
  std::function<bool(glm::dvec2)> grows_trees;
};

// In the order in which they lie on each other; rivers belong on top of all of them. A pure
// function of the rivers, the seed and what the two functions say.
std::vector<CoverRiver> river_shores(std::span<const CoverRiver> rivers,
                                     const ShoreParameters& parameters);

}  // namespace belvedere
