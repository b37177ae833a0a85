#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "terrain/layers/fit/ground_fit.h"

namespace belvedere::tools {

struct LayersFitReportInput {
  std::string title;               // what was fitted, a title
  std::string command;             // command that made it
  std::vector<std::string> notes;  // findings
  const KnownGround* ground = nullptr;
  const GroundFit* fit = nullptr;
  GroundFitParameters parameters;
  SurfaceLayers layers;  // as in the file
  std::string file;      // its name
};

// index.html, report.json and PNG pictures in a relocatable folder without network access: the
// inputs, colours and classes, the functions, the painting of one cell layer by layer, how well
// models predict classes on held-out ground (a chessboard, halves, each in both directions), and
// the picture beside its reproduction. The same bytes for any number of threads. Error(output).
void write_layers_fit_report(const std::string& folder, const LayersFitReportInput& input,
                             Progress& progress);

}  // namespace belvedere::tools
