#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "terrain/layers/fit/ground_fit.h"

namespace belvedere::tools {

struct LayersFitReportInput {
  std::string title;               // what was fitted, for people
  std::string command;             // that made it
  std::vector<std::string> notes;  // what was found
  const KnownGround* ground = nullptr;
  const GroundFit* fit = nullptr;
  GroundFitParameters parameters;
  SurfaceLayers layers;  // as in the file
};

// index.html, report.json and PNG pictures in a folder that can be moved and read without a network: the inputs, colours and classes, the
// functions, how one place is painted layer by layer, how well models tell classes on ground they have not seen (a chessboard, halves, each
// both ways), and the picture beside its reproduction. The same bytes for any number of threads. Error(output).
void write_layers_fit_report(const std::string& folder, const LayersFitReportInput& input, Progress& progress);

}  // namespace belvedere::tools
