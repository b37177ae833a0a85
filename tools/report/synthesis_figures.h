#pragma once

#include <functional>
#include <string>
#include <vector>

#include "texture/quality/quality.h"
#include "texture/synthesis/class_supply.h"
#include "tools/report/report.h"

namespace belvedere::tools {

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
// Class by class, with the texels that are there and needed.
ReportTable class_table(const SynthesisQuality& quality, const std::vector<ClassSupply>& supplies,
                        const std::function<std::string(std::uint8_t)>& class_name);

}  // namespace belvedere::tools
