#pragma once

#include <cstdint>
#include <vector>

#include "terrain/layers/fit/fit_cells.h"
#include "terrain/layers/fit/minimize.h"

namespace belvedere {

// What fit_product and fit_additive make small: minus the logarithm of the likelihood, a cell, and a penalty on rough functions.
// The same bits for any threads: sums go over fixed chunks of cells.

double sigmoid(double x);  // 1 / (1 + e^-x)

struct KnotParameters {
  int count = 32;           // of each function, linear between them; 2…256
  double roughness = 6e-4;  // weight of squared differences of neighbouring knots (in units of logits), ≥ 0
};

// Of one class (`own`, indices of cells) against those under it. Numbers: the logit of its bias, then the logits of its knots by input.
ValueAndGradient product_loss(const FitCells& cells, const std::vector<std::uint32_t>& own, const std::vector<std::uint32_t>& under,
                              const KnotParameters& knots);

// Shares of the classes among the cells in use, each counted once more than it is there.
std::vector<double> class_prior(const FitCells& cells, const std::vector<std::uint32_t>& use);
// Of all classes together: shares follow from prior times e to the sum of functions. Numbers: [input][knot][class].
ValueAndGradient additive_loss(const FitCells& cells, const std::vector<std::uint32_t>& use, std::vector<double> prior,
                               const KnotParameters& knots);

}  // namespace belvedere
