#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "texture/synthesis/exemplar.h"

namespace belvedere::quality {

// Squared distances of pixels from the border of their class: inside pixels are more than 8 pixels
// from it.
constexpr int inside_squared = 64;

// Sum of the channels: three times the gray value.
constexpr int sum_of(const Rgb8& c) { return c[0] + c[1] + c[2]; }

// Weights of the values 0…255.
using Histogram = std::array<double, 256>;

// Wasserstein-1 of two weighted samples of 8-bit values: mean distance of their quantiles (i + 1/2)
// / 256, in levels.
double wasserstein(const Histogram& a, const Histogram& b);
// Quantile of counted values 0, 1, 2 …, linear between neighbours like numpy's.
double quantile(const std::size_t* counts, std::size_t values, double at);

// Mean over 20 relative positions of the L1 distance between histograms (64 bins) of grey
// differences of pixel pairs within the class (Zalesny & Van Gool's clique statistics): output
// against exemplars, exemplars with their texels weighted (a pair by its left one; the weights of a
// class must not all be 0) against unweighted exemplars, output against weighted exemplars.
// Positions with fewer than 500 pairs in either picture are skipped.
struct CliqueDistances {
  double distance = 0.0;
  double floor = 0.0;
  double beyond_floor = 0.0;
};
CliqueDistances clique_distances(const Grid<Rgb8>& output, const Grid<std::uint8_t>& labels,
                                 const std::vector<Exemplar>& exemplars,
                                 const std::vector<Grid<float>>& weights, std::uint8_t label);

}  // namespace belvedere::quality
