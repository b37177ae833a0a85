#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "texture/synthesis/synth_setup.h"
#include "texture/synthesis/synthesis_plan.h"

namespace belvedere {

struct SynthesisPlan::Data {
  SynthesisSheet sheet;
  synth::Setup setup;
  std::vector<std::uint32_t> matches;                   // of the plan's level, row by row: texel of exemplars[level], or its nowhere
  synth::Demand demand;                                 // of the plan's level
  std::vector<std::vector<std::uint8_t>> usual_errors;  // by finer level
  std::vector<synth::Plane> exemplars;                  // levels 0 … plan; of the finer ones the pictures, of the plan's the places alone
  std::vector<std::shared_ptr<synth::LevelSource>> sources;  // by finer level
  std::uint64_t digest = 0;                                  // of the exemplars
};

}  // namespace belvedere
