#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "base/random.h"
#include "tests/grids.h"

namespace belvedere::test {

// Colours 0…1, no two pixels alike.
inline Grid<glm::vec3> random_picture(int width, int height, std::uint64_t seed = 1) {
  Grid<glm::vec3> out(width, height);
  for (const auto [x, y] : test::cells(width, height))
    for (int c = 0; c < 3; ++c)
      out(x, y)[c] = static_cast<float>(random_uniform(seed, x, y, static_cast<std::uint64_t>(c)));
  return out;
}

}  // namespace belvedere::test
