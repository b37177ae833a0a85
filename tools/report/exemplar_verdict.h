#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/text/json.h"
#include "texture/quality/exemplar_survey.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere::tools {

// Demand on all paintings together, where a target is known.
struct NeededClassTexels {
  ClassTexels available;
  struct Guide {
    GuideFit fit;
    double cost = 0.0;  // mean price of its errors, where each pixel takes the nearest texel
  };
  std::vector<Guide> guides = {};  // the most expensive first
};

// Everything `exemplar check` found.
struct ExemplarFindings {
  struct Painting {
    std::string name;
    int width = 0;
    int height = 0;
    ExemplarSurvey survey;
  };
  std::vector<Painting> paintings;
  // Texture models besides, which have no texels.
  struct Model {
    std::string name;
    std::vector<std::uint8_t> labels;  // that it paints
    bool always = false;  // else only where paintings have no texels of a class, or too few
  };
  std::vector<Model> models;
  bool target_known = false;
  std::vector<NeededClassTexels> demands;  // by label
  std::vector<std::pair<std::uint8_t, double>>
      missing;  // classes without texels and fallback, and their pixels
  struct StandIn {
    std::uint8_t label = 0, by = 0;  // a class without texels, and the one it copies from
    double pixels = 0.0;
  };
  std::vector<StandIn> stand_ins;
  std::vector<GuideShare> explained;                          // what guides explain of the paint
  std::function<std::string(std::uint8_t)> name;              // of a label
  std::function<std::string(const std::string&, int)> value;  // of a guide, formatted
};

// Weaknesses of a class of a painting, each a short sentence; empty: none.
std::vector<std::string> describe_flaws(const ClassSurvey& of, const ExemplarFindings& findings);
// "serves pictures of up to 800 000 pixels of it", or the demand and whether it is met.
std::string describe_service(const ClassSurvey& of);
std::string describe_needed_texels(const NeededClassTexels& demand);

std::string findings_text(const ExemplarFindings& findings);
Json findings_json(const ExemplarFindings& findings);

// The findings of `exemplar check` with pictures, in a relocatable folder without network access:
// index.html, report.json, each painting beside its classes, a swatch of every class, and for each
// guide the values at which a class was painted and, where `asked` has labels (those that pixels
// copy from) and the guide, the values asked for. exemplars: those of the findings. Throws
// Error(output).
void write_exemplar_report(const std::string& folder, const std::vector<Exemplar>& exemplars,
                           const GuideStack& asked, const ExemplarFindings& findings,
                           const std::string& command);

}  // namespace belvedere::tools
