#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "base/grid.h"
#include "terrain/generalize/generalize.h"

namespace belvedere::tools {

// What a report speaks of: a terrain before and after, and how it was made.
struct GeneralizeReportInput {
  std::string title;                       // as people call the terrain
  std::string command;                     // that makes the result
  const Grid<float>& before_m;             // finite
  const Grid<float>& after_m;              // finite, of that size
  glm::dvec2 cell_m;                       // on the ground
  const GeneralizeGrids& grids;            // as the result was made with; an empty share: near is the south, far the north
  const GeneralizeParameters& parameters;  // likewise
};

}  // namespace belvedere::tools
