#pragma once

#include <cstddef>
#include <vector>

#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/match_field.h"

namespace belvedere {

// How much seams show: pixels side by side that were not side by side in a painting. Each step (|R − R'| + |G − G'| + |B − B'|) / 3 is set
// against what neighbours of the same two classes are apart in the paintings it comes from (the mean of the two paintings' means).
// Where neither has these classes side by side: what texels of the two classes are apart by chance, times the share of that by which the
// paintings' other borders step; a painting of another tone does not show there, for nothing tells how the classes would meet. 1: seams
// step as neighbours of the painting do.
struct SeamVisibility {
  std::size_t pairs = 0;     // of 4-neighbours, those across silhouettes left out: there the land itself steps
  std::size_t compared = 0;  // of those, the ones whose paintings have something to compare with
  double step = 0.0;         // mean over pairs, levels of 255
  double visibility = 0.0;   // sum of steps / sum of the paintings' own, over compared pairs; 0: none, or paintings without any step
};
struct SeamsOfKinds {
  SeamVisibility within;   // both pixels from one painting
  SeamVisibility between;  // from different paintings
};

// Seams inside paintings and between them. Matches must lie inside the exemplars; depth_m may be empty: no silhouettes.
SeamsOfKinds seam_visibility(const MatchField& matches, const std::vector<Exemplar>& exemplars, const Grid<float>& depth_m,
                             float depth_ratio);

}  // namespace belvedere
