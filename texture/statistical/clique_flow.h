#pragma once

#include <vector>

#include "texture/statistical/band_pyramid.h"
#include "texture/statistical/clique_model.h"

namespace belvedere {

// The flow: all histograms of differences are moved to the model's at once, round after round, as a transport: each difference to the value
// of the same share in the model. It reaches in a second what sampling pixel by pixel takes half a minute for.

// How far a difference of a type should move, at the edges of its histogram's bins; linear between them.
using FlowTable = std::vector<float>;
// Tables of all types of the levels that a round looks at, in the model's order from `level` to the coarsest.
using FlowRound = std::vector<FlowTable>;

struct FlowStep {
  float rate = 0.8F;      // of the mean of what all cliques of a pixel ask for; above 1 several levels push too far together
  float momentum = 0.6F;  // of the last round's move that goes on; 0 in the last rounds, so that what is reached stands
};

// A texture in the making: pictures of all levels and the moves of the level that is worked on.
struct FlowState {
  BandPyramid pyramid;
  BandPicture speed;  // of the finest level in work; sized by the first round at a level
};

// What the differences of `picture` lack to be the model's.
FlowRound find_tables(const BandPyramid& pyramid, const CliqueModel& model, int level);
// One round at `level`: the coarser levels are made anew from it, asked with `tables`, and what they ask for is handed down.
void flow(FlowState& state, const CliqueModel& model, int level, const FlowRound& tables, FlowStep step);

// Makes coarser pictures from the one at `level`.
void renew_coarser(BandPyramid& pyramid, int level);

}  // namespace belvedere
