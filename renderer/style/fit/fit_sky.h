#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "renderer/style/fit/style_painting.h"
#include "renderer/style/style.h"

namespace belvedere {

struct SkyFitParameters {
  int columns = 3;  // of the grid of medians
  int rows = 5;
  std::size_t min_texels = 600;      // of a sky
  std::size_t min_cell_texels = 60;  // cells with fewer take their row's median
};

struct FittedSky {
  StyleSky sky;                      // empty: the painting has none
  std::vector<glm::dvec3> gradient;  // median of each row, top to horizon
  glm::dvec3 cloud_light{0.0};
  glm::dvec3 cloud_shade{0.0};
};

// Fits the sky of a painting (recipe B7): medians over a grid; of the remainder at the size of
// clouds the two principal components of colour, the horizontal and vertical lags at which their
// autocorrelation has fallen to one half, and the quantiles of their amounts. An axis has the
// length of one standard deviation and points towards light.
FittedSky fit_sky(const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
                  const SkyFitParameters& parameters = {});

}  // namespace belvedere
