#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/text/json.h"
#include "texture/quality/exemplar_survey.h"
#include "texture/synthesis/class_supply.h"

namespace belvedere::tools {

// What is asked of the paintings together, where a target is known.
struct ClassDemand {
  ClassSupply supply;
  double altitude_covered = -1.0;  // share of its pixels that find texels of their altitude; < 0: not known
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
  // Texture models beside them, which have no texels.
  struct Model {
    std::string name;
    std::vector<std::uint8_t> labels;  // that it paints
    bool always = false;               // else where paintings have no texels of a class, or too few
  };
  std::vector<Model> models;
  bool target_known = false;
  std::vector<ClassDemand> demands;                           // by label
  std::vector<std::pair<std::uint8_t, double>> missing;       // classes without texels and fallback, and their pixels
  std::function<std::string(std::uint8_t)> name;              // of a label
  std::function<std::string(const std::string&, int)> value;  // of a guide, as people read it
};

// What is wrong with a class of a painting, each a short sentence; empty: nothing.
std::vector<std::string> describe_flaws(const ClassSurvey& of, const ExemplarFindings& findings);
// "serves pictures of up to 800 000 pixels of it", or what is asked and whether that is enough.
std::string describe_service(const ClassSurvey& of);
std::string describe_demand(const ClassDemand& demand);

std::string findings_text(const ExemplarFindings& findings);
Json findings_json(const ExemplarFindings& findings);

}  // namespace belvedere::tools
