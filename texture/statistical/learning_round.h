#pragma once

#include <cstddef>
#include <vector>

#include "texture/statistical/band_pyramid.h"
#include "texture/statistical/difference_histogram.h"

namespace belvedere {

// What both ways of learning do in each round (Zalesny et al. 2005, steps 3 to 5): count all types in what was made, and find the one whose
// histogram is farthest from the crop's.

// A clique type that may be added, with the crop's distribution.
struct CliqueCandidate {
  Clique clique;
  HistogramGroups groups;
  bool in = false;
};

// Of the given types, from the crop at their level.
std::vector<CliqueCandidate> make_candidates(const BandPicture& example, const BandSpace& bands, const std::vector<CliqueType>& types);

// How a level's learning went.
struct LearnedLevel {
  int level = 0;
  int types = 0;             // of this level
  double held_out_l1 = 0.0;  // mean over the types that are left out
  double worst_l2 = 0.0;     // of these
};

// How far those that are left out are from the crop.
struct LearningRound {
  LearnedLevel told;      // without its level; `types`: those that are in
  std::size_t worst = 0;  // candidates.size(): none is left out, or none differs
};
LearningRound judge_candidates(const std::vector<CliqueCandidate>& candidates, const BandPicture& made, const BandSpace& bands);

}  // namespace belvedere
