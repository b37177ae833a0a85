#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "texture/sheet/synthesis_sheet.h"
#include "texture/synthesis/synth_setup.h"

namespace belvedere {

// What a plan holds; for who makes, packs and uses plans alone.
struct SynthesisPlanData {
  SynthesisSheet sheet;
  synth::Setup setup;
  std::vector<std::uint32_t> matches;                   // of the plan's level, row by row: texel of exemplars[level], or its nowhere
  synth::Demand demand;                                 // of the plan's level
  std::vector<std::vector<std::uint8_t>> usual_errors;  // by finer level
  std::vector<synth::Plane> exemplars;                  // levels 0 … plan; of the finer ones the pictures, of the plan's the places alone
  std::vector<std::shared_ptr<synth::LevelSource>> sources;  // by finer level
  std::uint64_t digest = 0;                                  // of the exemplars
};

// Of all that synthesis reads of the exemplars.
std::uint64_t digest_of(const synth::Plane& exemplars);
// The part of the plan that is made from the exemplars and what was counted in the small view. planes: levels 0 … the plan's at least.
void make_sources(SynthesisPlanData& data, std::vector<synth::Plane> planes);

}  // namespace belvedere
