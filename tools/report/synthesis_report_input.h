#pragma once

#include <functional>
#include <string>
#include <vector>

#include "texture/synthesis/match_field.h"
#include "texture/synthesis/synthesize.h"

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

}  // namespace belvedere::tools
