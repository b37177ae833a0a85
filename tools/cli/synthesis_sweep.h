#pragma once

#include <string>
#include <vector>

#include "base/progress.h"
#include "texture/synthesis/synthesize.h"

namespace belvedere::tools {

// A parameter of synthesis or the weight of a guide, with the values that a sweep tries.
struct SweepAxis {
  std::string name;
  std::vector<std::string> texts;  // as typed
  std::vector<double> values;
};

// "reuse=0,1,4". Names: seed, levels, reuse, copy-cap, neighbourhood, surroundings, or one of
// `guides`. Error(usage) for unknown names, values out of range or not numeric, and an empty list.
SweepAxis parse_sweep(const std::string& text, const std::vector<std::string>& guides);
// The parameters with that value set; it must come from parse_sweep.
SynthesisParameters with_value(SynthesisParameters parameters, const std::string& name,
                               double value);

struct SweepInput {
  std::string title;
  std::string command;          // without folders
  std::vector<SweepAxis> axes;  // one or two: along the columns, down the rows
  const std::vector<Exemplar>& exemplars;
  const GuideStack& target;
  const SynthesisParameters& parameters;  // parameters that the axes do not change
};

// A synthesis for every pair of values. In the folder: sheet.png, all results side by side with
// their values written in (small pictures whole, of larger ones the same part at full size); each
// full result, 1_2.png for the first column's second row; index.html with the sheet and a table of
// key figures; report.json. Error(usage) for more than 100 syntheses, Error(output). Returns their
// number.
int write_sweep(const std::string& folder, const SweepInput& input, Progress& progress);

}  // namespace belvedere::tools
