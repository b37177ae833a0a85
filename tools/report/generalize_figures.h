#pragma once

#include "base/progress.h"
#include "tools/report/generalize_report_input.h"
#include "tools/report/report.h"

namespace belvedere::tools {

inline constexpr int window_px = 420;  // longest side of a part shown cell by cell, where fine detail can be seen

// The windows that a report's pictures look through.
struct FigureWindows {
  PixelRect ridges;     // most ridge lines
  PixelRect near, far;  // most ridge lines of the near and of the far quarter
};
FigureWindows choose_windows(const Grid<float>& altitude_m, glm::dvec2 cell_m, const Grid<float>& share);

// Figures 1 to 5 of Jenny, Jenny & Hurni 2011 from the terrain before. `share`: what figure 4 takes for near.
void add_paper_figures(Report& page, const GeneralizeReportInput& in, const Grid<float>& share, const FigureWindows& windows,
                       Progress& progress);

}  // namespace belvedere::tools
