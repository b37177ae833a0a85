#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "base/pixel_rect.h"
#include "texture/quality/quality.h"
#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/synthesize.h"
#include "tools/report/report.h"

namespace belvedere::tools {

// Input of a report on a synthesis.
struct SynthesisReportInput {
  std::string title;    // name of the result
  std::string command;  // command that makes it, without folders
  const std::vector<Exemplar>& exemplars;
  const GuideStack& target;
  const SynthesisParameters& parameters;  // as the result was made with
  const MatchField& matches;
  std::function<std::string(std::uint8_t)> class_name;
};

inline constexpr int worst_place_side = 64;  // pixels

// Demand and cost of a guide, over the pixels that have a texel.
struct GuideFindings {
  std::string name;
  double weight = 1.0;
  double error_mean = 0.0;
  float error_95 = 0.F;
  double cost_mean = 0.0;
};

// A window worth a look, with where most of it was copied from.
struct Place {
  std::string letter;
  std::string why;
  std::string guide;  // what is bad about it; empty: none
  PixelRect window;
  std::size_t exemplar = 0;
  PixelRect source;
  std::size_t piece = 0;  // pixels of the window copied by the source's offset
};

// The numbers of a report, and the maps they are computed from.
struct SynthesisFindings {
  SynthesisQuality quality;
  std::vector<ClassTexels> available;
  std::vector<GuideFindings> guides;  // the most expensive first
  double seam_mean = 0.0;
  std::vector<Place> positions;
  Grid<float> seams;                      // cost by pixel
  std::vector<Grid<std::uint32_t>> uses;  // of texels, by exemplar
  Grid<float> use_counts;                 // by pixel: of its texel
};

SynthesisFindings look_at_synthesis(const SynthesisReportInput& input, Progress& progress);

// Cost of that guide by pixel, at its weight.
Grid<float> guide_cost_map(const SynthesisReportInput& input, const std::string& guide);

// A figure of the quality of a synthesis, its meaning, and its good range.
struct QualityFigure {
  std::string key;    // in JSON
  std::string name;   // on pages
  std::string brief;  // at the head of a column
  double value = 0.0;
  double min = 0.0;
  double max = 0.0;
  bool good() const { return value >= min && value <= max; }
};
// Figures of a whole picture; those of classes by the worst of them.
std::vector<QualityFigure> key_figures(const SynthesisQuality& quality);
// Class by class, with available and needed texels.
ReportTable class_table(const SynthesisQuality& quality, const std::vector<ClassTexels>& supplies,
                        const std::function<std::string(std::uint8_t)>& class_name);

}  // namespace belvedere::tools
