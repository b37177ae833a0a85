#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "renderer/style/fit/style_painting.h"
#include "renderer/style/style.h"

namespace belvedere {

struct SkyParameters {
  int columns = 3;  // of the grid of medians
  int rows = 5;
  std::size_t min_texels = 600;      // of a sky
  std::size_t min_cell_texels = 60;  // cells of fewer take their row's median
};

struct FittedSky {
  StyleSky sky;                      // empty: the painting has none
  std::vector<glm::dvec3> gradient;  // median of each row, top to horizon
  glm::dvec3 cloud_light{0.0};
  glm::dvec3 cloud_shade{0.0};
};

// The sky of a painting (recipe B7): medians over a grid, and what is left of it at the size of
// clouds: its two principal changes of colour, the distances along and down at which the first and
// second have lost half of their correlation, and the quantiles of their amounts. Axes are of one
// deviation each and point to the light.
FittedSky fit_sky(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
                  const SkyParameters& parameters = {});

}  // namespace belvedere
