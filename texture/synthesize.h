#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "renderer/base/progress.h"
#include "texture/exemplar.h"
#include "texture/guide_stack.h"
#include "texture/match_field.h"

namespace belvedere {

struct SynthesisParameters {
  std::uint64_t seed = 1;
  int levels = 6;                                           // 1…8, fewer where the smallest side would fall under 16
  std::vector<std::pair<std::string, double>> weights;      // by guide name; absent: 1; 0 switches a guide off; 0…100
  std::map<std::uint8_t, std::uint8_t> fallback;            // class → class to copy from where no exemplar has any texel of it
  double reuse = 1.0;                                       // strength of the reuse penalty, 0…10
  int copy_cap = 240;                                       // largest piece copied in one, texels at level 0; 16…100000
};

// Guided texture synthesis (design section 8, synthesis/recipe.md): the match field of the target. Label-filtered coherent
// candidates and picks by guides, coarse to fine, integer costs, double-buffered parity passes: the same for any threads.
// Guides are paired by name; one that exists on one side only is unused, and progress.note says so once. A class without
// texels takes its fallback, or Match::none. Throws Error(usage) where exemplars are empty or sizes disagree.
MatchField synthesize(const std::vector<Exemplar>& exemplars, const GuideStack& target, const SynthesisParameters& parameters,
                      Progress& progress);

}  // namespace belvedere
