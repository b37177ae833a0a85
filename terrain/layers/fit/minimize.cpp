#include "terrain/layers/fit/minimize.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <utility>

namespace belvedere {
namespace {

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0.0;
  for (std::size_t i = 0; i != a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

struct Pair {
  std::vector<double> step;
  std::vector<double> change;  // of the gradient along the step
  double curvature = 0.0;      // their product, > 0
};

// Minus the inverse Hessian, as the pairs know it, times the gradient (the two-loop recursion).
std::vector<double> direction_of(const std::deque<Pair>& pairs, const std::vector<double>& gradient) {
  std::vector<double> q(gradient.size());
  for (std::size_t i = 0; i != q.size(); ++i) q[i] = -gradient[i];
  std::vector<double> weight(pairs.size());
  for (std::size_t p = pairs.size(); p-- != 0;) {
    weight[p] = dot(pairs[p].step, q) / pairs[p].curvature;
    for (std::size_t i = 0; i != q.size(); ++i) q[i] -= weight[p] * pairs[p].change[i];
  }
  const double scale = pairs.empty() ? 1.0 / std::max(1.0, std::sqrt(dot(gradient, gradient)))
                                     : pairs.back().curvature / dot(pairs.back().change, pairs.back().change);
  for (double& v : q) v *= scale;
  for (std::size_t p = 0; p != pairs.size(); ++p) {
    const double back = weight[p] - dot(pairs[p].change, q) / pairs[p].curvature;
    for (std::size_t i = 0; i != q.size(); ++i) q[i] += back * pairs[p].step[i];
  }
  return q;
}

}  // namespace

MinimizeResult minimize(std::vector<double> start, const ValueAndGradient& function, const MinimizeParameters& parameters) {
  constexpr double sufficient = 1e-4;  // of the decrease that the slope promises
  constexpr double flatter = 0.9;      // the slope at the new place is at most this share of the old one
  constexpr int most_tries = 30;
  MinimizeResult result;
  result.at = std::move(start);
  std::vector<double> gradient(result.at.size());
  result.value = function(result.at, gradient);
  result.evaluations = 1;
  std::deque<Pair> pairs;
  std::vector<double> there(result.at.size());
  std::vector<double> gradient_there(result.at.size());
  while (result.steps != parameters.steps) {
    std::vector<double> direction = direction_of(pairs, gradient);
    double slope = dot(direction, gradient);
    if (!(slope < 0.0)) {
      if (pairs.empty()) break;  // the gradient vanishes
      pairs.clear();
      continue;
    }
    double low = 0.0;
    double high = 0.0;  // 0: none is known yet
    double length = 1.0;
    double value = result.value;
    bool descends = false;
    for (int attempt = 0; attempt != most_tries; ++attempt) {
      for (std::size_t i = 0; i != there.size(); ++i) there[i] = result.at[i] + length * direction[i];
      value = function(there, gradient_there);
      ++result.evaluations;
      descends = value <= result.value + sufficient * length * slope;
      if (!descends)
        high = length;
      else if (dot(gradient_there, direction) < flatter * slope)
        low = length;
      else
        break;
      length = high > 0.0 ? 0.5 * (low + high) : 2.0 * length;
    }
    if (!descends) {
      if (pairs.empty()) break;  // not even along the gradient: as low as numbers tell
      pairs.clear();
      continue;
    }
    Pair pair{std::vector<double>(there.size()), std::vector<double>(there.size()), 0.0};
    for (std::size_t i = 0; i != there.size(); ++i) {
      pair.step[i] = there[i] - result.at[i];
      pair.change[i] = gradient_there[i] - gradient[i];
    }
    pair.curvature = dot(pair.step, pair.change);
    if (pair.curvature > 1e-300) {
      if (pairs.size() == static_cast<std::size_t>(parameters.memory)) pairs.pop_front();
      pairs.push_back(std::move(pair));
    }
    const double gained = result.value - value;
    result.at.swap(there);
    gradient.swap(gradient_there);
    result.value = value;
    ++result.steps;
    if (gained <= parameters.tolerance * std::max(std::abs(value), 1e-12)) break;
  }
  return result;
}

}  // namespace belvedere
