#pragma once

#include <functional>
#include <string>
#include <vector>

#include "texture/quality/quality.h"
#include "texture/synthesis/class_texels.h"
#include "tools/report/report.h"

namespace belvedere::tools {

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
