#pragma once

#include <functional>
#include <span>
#include <vector>

namespace belvedere {

struct MinimizeParameters {
  int steps = 150;          // maximum, ≥ 1
  double tolerance = 1e-9;  // stops if a step gains less than this share of the value, ≥ 0
};
struct MinimizeResult {
  std::vector<double> at;
  double value = 0.0;
  int steps = 0;
  int evaluations = 0;
};

// Returns the value at x, ≥ 0, and writes the gradient, both of finite numbers; throws nothing.
using ValueAndGradient =
    std::function<double(std::span<const double> x, std::span<double> gradient)>;

// Unconstrained minimum of a smooth function by limited-memory BFGS (Nocedal 1980) of libLBFGS.
// Single-threaded, and the only library function is the square root: the same bits wherever the
// function gives them.
MinimizeResult minimize(const std::vector<double>& start, const ValueAndGradient& function,
                        const MinimizeParameters& parameters = {});

}  // namespace belvedere
