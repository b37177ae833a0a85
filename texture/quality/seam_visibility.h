#pragma once

#include <cstddef>
#include <vector>

#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/match_field.h"

namespace belvedere {

// Visibility of seams: pixels side by side that were not side by side in a painting. Each step (|R
// − R'| + |G − G'| + |B − B'|) / 3 is compared with the steps between neighbours of the same two
// classes in the source paintings (the mean of the two paintings' means). If neither has these
// classes side by side: the step of random texels of the two classes, times the ratio of actual to
// random steps at the paintings' other borders; this does not detect a painting of another tone,
// because no reference shows how the classes would meet. 1: seams step as neighbours in the
// painting do.
struct SeamVisibility {
  std::size_t pairs =
      0;  // of 4-neighbours, except across silhouettes, where the ground itself steps
  std::size_t compared = 0;  // those with a reference in the paintings
  double step = 0.0;         // mean over pairs, levels of 255
  double visibility = 0.0;   // sum of steps / sum of the paintings' own, over compared pairs; 0:
                             // none, or paintings without any step
};
struct SeamsOfKinds {
  SeamVisibility within;   // both pixels from one painting
  SeamVisibility between;  // from different paintings
};

// Seams inside paintings and between them. Matches must be inside the exemplars; depth_m may be
// empty: no silhouettes.
SeamsOfKinds seam_visibility(const MatchField& matches, const std::vector<Exemplar>& exemplars,
                             const Grid<float>& depth_m, float depth_ratio);

}  // namespace belvedere
