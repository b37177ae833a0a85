#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/json.h"
#include "base/progress.h"
#include "texture/quality/quality.h"
#include "texture/synthesis/match_field.h"
#include "texture/synthesis/synthesize.h"

namespace belvedere::tools {

// What a report on a synthesis speaks of.
struct SynthesisReportInput {
  std::string title;    // as people call the result
  std::string command;  // that makes it, without folders
  const std::vector<Exemplar>& exemplars;
  const GuideStack& target;
  const SynthesisParameters& parameters;  // as the result was made with
  const MatchField& matches;
  std::function<std::string(std::uint8_t)> class_name;
};

// index.html, report.json and the PNG pictures that the page shows, in a folder (made where it is missing) that can be moved and read
// without a network: figures of quality, maps of where texels come from, of their reuse and of what seams and each guide cost, and the
// worst places beside their sources. The same input gives the same bytes for any number of threads. Throws Error(output).
void write_synthesis_report(const std::string& folder, const SynthesisReportInput& input, Progress& progress);

// A figure of the quality of a synthesis, what it is, and the range in which eyes are content.
struct QualityFigure {
  std::string key;    // in JSON
  std::string name;   // on pages
  std::string brief;  // at the head of a column
  double value = 0.0;
  double least = 0.0;
  double most = 0.0;
  bool good() const { return value >= least && value <= most; }
};
// Those of a whole picture; those of classes by the worst of them.
std::vector<QualityFigure> key_figures(const SynthesisQuality& quality);
Json quality_json(const SynthesisQuality& quality, const std::function<std::string(std::uint8_t)>& class_name);

}  // namespace belvedere::tools
