#pragma once

#include "base/pixel_rect.h"
#include "base/progress.h"
#include "tools/report/generalize_report_input.h"
#include "tools/report/report.h"

namespace belvedere::tools {

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
