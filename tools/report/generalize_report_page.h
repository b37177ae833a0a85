#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "terrain/generalize/generalize.h"
#include "tools/report/report.h"

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

// index.html, report.json and the PNG pictures that the page shows, in a relocatable folder
// (created if missing) without network access. The figures 1 to 5 of Jenny, Jenny & Hurni 2011 are
// made again from this terrain. The same input gives the same bytes for any number of threads.
// Throws Error(output).
void write_generalize_report(const std::string& folder, const GeneralizeReportInput& input,
                             Progress& progress);

inline constexpr int window_px =
    420;  // longest side of a part shown cell by cell, where fine detail is visible

// The windows of a report's pictures.
struct FigureWindows {
  PixelRect ridges;     // most ridge lines
  PixelRect near, far;  // most ridge lines of the near and of the far quarter
};
FigureWindows choose_windows(const Grid<float>& altitude_m, glm::dvec2 cell_m,
                             const Grid<float>& share);

// Figures 1 to 5 of Jenny, Jenny & Hurni 2011 from the original terrain. `share`: foreground share
// of figure 4.
void add_paper_figures(Report& page, const GeneralizeReportInput& in, const Grid<float>& share,
                       const FigureWindows& windows, Progress& progress);

}  // namespace belvedere::tools
