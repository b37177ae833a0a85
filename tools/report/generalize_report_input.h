#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "base/grid.h"
#include "terrain/generalize/generalize.h"

namespace belvedere::tools {

// Input of a report: a terrain before and after generalization, and its parameters.
struct GeneralizeReportInput {
  std::string title;            // name of the terrain
  std::string command;          // command that makes the result
  const Grid<float>& before_m;  // finite
  const Grid<float>& after_m;   // finite, of that size
  glm::dvec2 cell_m;            // on the ground
  const GeneralizeGrids&
      grids;  // as the result was made with; an empty share: near is the south, far the north
  const GeneralizeParameters& parameters;  // likewise
};

}  // namespace belvedere::tools
