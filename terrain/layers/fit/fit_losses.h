#pragma once

#include <cstdint>
#include <vector>

#include "terrain/layers/fit/fit_cells.h"
#include "terrain/layers/fit/minimize.h"

namespace belvedere {

// The objectives of fit_product and fit_additive: the negative log likelihood per cell plus a
// roughness penalty. The same bits for any threads: sums use fixed chunks of cells.

double sigmoid(double x);  // 1 / (1 + e^-x)

struct KnotParameters {
  int count = 32;  // of each function, linear between them; 2…256
  double roughness =
      6e-4;  // weight of squared differences of neighbouring knots (in units of logits), ≥ 0
};

// For one class (`own`, indices of cells) against those under it. Parameters: the logit of its
// bias, then the logits of its knots by input.
ValueAndGradient product_loss(const FitCells& cells, const std::vector<std::uint32_t>& own,
                              const std::vector<std::uint32_t>& under, const KnotParameters& knots);

// Shares of the classes among the used cells, with one extra count each.
std::vector<double> class_prior(const FitCells& cells, const std::vector<std::uint32_t>& use);
// For all classes together: shares are proportional to the prior times e to the sum of functions.
// Parameters: [input][knot][class].
ValueAndGradient additive_loss(const FitCells& cells, const std::vector<std::uint32_t>& use,
                               std::vector<double> prior, const KnotParameters& knots);

}  // namespace belvedere
