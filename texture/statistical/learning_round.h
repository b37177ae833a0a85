#pragma once

#include <cstddef>
#include <vector>

#include "texture/statistical/band_pyramid.h"
#include "texture/statistical/difference_histogram.h"

namespace belvedere {

// The common part of both learning methods in each round (Zalesny et al. 2005, steps 3 to 5): count
// all types in the texture made, and find the one whose histogram is farthest from the crop's.

// A clique type that may be added, with the crop's distribution.
struct CliqueCandidate {
  Clique clique;
  HistogramGroups groups;
  bool in = false;
};

// For the given types, from the crop at their level.
std::vector<CliqueCandidate> make_candidates(const BandPicture& example, const BandSpace& bands,
                                             const std::vector<CliqueType>& types);

// Result of learning a level.
struct LearnedLevel {
  int level = 0;
  int types = 0;             // of this level
  double held_out_l1 = 0.0;  // mean over the types not included
  double worst_l2 = 0.0;     // of these
};

// Distances from the crop for the types not included.
struct LearningRound {
  LearnedLevel told;      // without its level; `types`: those included
  std::size_t worst = 0;  // candidates.size(): all are included, or none differs
};
LearningRound evaluate_candidates(const std::vector<CliqueCandidate>& candidates,
                                  const BandPicture& made, const BandSpace& bands);

}  // namespace belvedere
