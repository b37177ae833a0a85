#pragma once

#include <vector>

#include "texture/statistical/band_pyramid.h"
#include "texture/statistical/clique_model.h"

namespace belvedere {

// The flow: all histograms of differences are moved to the model's together, in rounds, as a
// transport: each difference towards the value of the same quantile in the model. It achieves in a
// second what sampling pixel by pixel takes half a minute for.

// How far a difference of a type should move, at the edges of its histogram's bins; linear between
// them.
using FlowTable = std::vector<float>;
// Tables of all types of the levels in a round, in the model's order from `level` to the coarsest.
using FlowRound = std::vector<FlowTable>;

struct FlowStep {
  float rate = 0.8F;  // factor on the mean of the requests of a pixel's cliques; above 1 several
                      // levels together overshoot
  float momentum = 0.6F;  // share of the last round's move that continues; 0 in the last rounds, so
                          // that the result is stable
};

// A texture in progress: pictures of all levels and the moves of the current level.
struct FlowState {
  BandPyramid pyramid;
  BandPicture speed;  // of the finest current level; sized by the first round at a level
};

// Tables that move the differences of `picture` to the model's.
FlowRound find_tables(const BandPyramid& pyramid, const CliqueModel& model, int level);
// One round at `level`: the coarser levels are recomputed from it, evaluated with `tables`, and
// their requests are propagated down.
void flow(FlowState& state, const CliqueModel& model, int level, const FlowRound& tables,
          FlowStep step);

// Makes coarser pictures from the one at `level`.
void renew_coarser(BandPyramid& pyramid, int level);

}  // namespace belvedere
