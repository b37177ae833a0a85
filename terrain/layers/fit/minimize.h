#pragma once

#include <functional>
#include <span>
#include <vector>

namespace belvedere {

struct MinimizeParameters {
  int steps = 150;          // at most, ≥ 0
  int memory = 10;          // pairs of steps and changes of the gradient that are remembered, ≥ 1
  double tolerance = 1e-9;  // stops where a step gains less than this share of the value, ≥ 0
};
struct MinimizeResult {
  std::vector<double> at;
  double value = 0.0;
  int steps = 0;
  int evaluations = 0;
};

// Returns the value at x and writes the gradient, both of finite numbers.
using ValueAndGradient = std::function<double(std::span<const double> x, std::span<double> gradient)>;

// A minimum of a smooth function without bounds: limited-memory BFGS (Nocedal 1980; Nocedal and Wright, "Numerical Optimization", 2006,
// algorithms 7.4 and 7.5) with a line search to the weak Wolfe conditions by doubling and bisection (Lewis and Overton 2013). One thread
// and sums in one order: the same bits wherever the function gives them.
MinimizeResult minimize(std::vector<double> start, const ValueAndGradient& function, const MinimizeParameters& parameters = {});

}  // namespace belvedere
