#pragma once

#include <cstddef>
#include <vector>

#include "terrain/register/pair_fit.h"

namespace belvedere {

// A fit whose first pairs are those of `index`, in their order; places found in the paint follow.
struct WeighedPairs {
  PairFit fit;
  std::vector<std::size_t> index;
  PairJudgement judgement;
};

// Mean score of the pairs themselves.
double mean_score(const WeighedPairs& weighed);

// Of Student's t with 4 degrees of freedom, two values at once; hardly any beyond all doubt.
double weight_of(double square_deviations);

// Weights by agreement with the others, the view and mountains in turn; the likeliest of these
// rounds counts. Pairs keep a quarter of their weight.
void weigh_by_agreement(WeighedPairs& weighed, double sigma_px, int rounds);

}  // namespace belvedere
