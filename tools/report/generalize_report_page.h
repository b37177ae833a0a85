#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "terrain/generalize/generalize.h"
#include "terrain/io/raster.h"

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

// index.html, report.json and the PNG pictures that the page shows, in a folder (made where it is missing) that can be moved and read
// without a network. The figures 1 to 5 of Jenny, Jenny & Hurni 2011 are made again from this terrain. The same input gives the same bytes
// for any number of threads. Throws Error(output).
void write_generalize_report(const std::string& folder, const GeneralizeReportInput& input, Progress& progress);

}  // namespace belvedere::tools
