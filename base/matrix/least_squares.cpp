#include "base/matrix/least_squares.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/math_exact.h"

namespace belvedere {
namespace {

double cost_of(const Residuals& residuals, std::size_t robust) {
  double cost = 0.0;
  for (std::size_t i = 0; i < residuals.values.size(); ++i) {
    const double square = residuals.values[i] * residuals.values[i];
    cost += 0.5 * (i < robust ? exact::log(1.0 + square) : square);
  }
  return cost;
}

struct Normal {
  Matrix matrix;
  std::vector<double> gradient;
};

Normal normal_of(const Residuals& residuals, std::size_t robust) {
  const std::size_t n = residuals.slopes.columns();
  Normal out{Matrix(n, n), std::vector<double>(n, 0.0)};
  for (std::size_t row = 0; row < residuals.values.size(); ++row) {
    const double r = residuals.values[row];
    const double weight = row < robust ? 1.0 / (1.0 + r * r) : 1.0;
    const std::span<const double> slope = residuals.slopes.row(row);
    for (std::size_t i = 0; i < n; ++i) {
      out.gradient[i] += weight * slope[i] * r;
      for (std::size_t k = 0; k <= i; ++k) out.matrix(i, k) += weight * slope[i] * slope[k];
    }
  }
  return out;
}

std::optional<std::vector<double>> damped_step(const Normal& normal, double damping) {
  // An unknown without any effect still needs a pivot.
  constexpr double min_diagonal = 1e-12;
  Matrix damped = normal.matrix;
  for (std::size_t i = 0; i < damped.rows(); ++i)
    damped(i, i) += damping * std::max(damped(i, i), min_diagonal);
  const std::optional<Cholesky> factors = Cholesky::of(std::move(damped));
  if (!factors) return std::nullopt;
  return factors->solve(normal.gradient);
}

}  // namespace

LeastSquaresFit fit_least_squares(std::vector<double> start, ResidualFunction function,
                                  const LeastSquaresParameters& parameters) {
  LeastSquaresFit fit{std::move(start), 0.0, 0};
  Residuals here = function(fit.at);
  fit.cost = cost_of(here, parameters.robust);
  constexpr double first_damping = 1e-3, max_damping = 1e12;
  constexpr double raise = 4.0, lower = 0.2;
  double damping = first_damping;
  while (fit.steps < parameters.max_steps && damping < max_damping) {
    const Normal normal = normal_of(here, parameters.robust);
    bool better = false;
    while (!better && damping < max_damping) {
      const std::optional<std::vector<double>> step = damped_step(normal, damping);
      std::vector<double> next = fit.at;
      for (std::size_t i = 0; step && i < next.size(); ++i) next[i] -= (*step)[i];
      Residuals there = step ? function(next) : Residuals{};
      const double cost = cost_of(there, parameters.robust);
      better = step && cost < fit.cost;
      if (!better) {
        damping *= raise;
        continue;
      }
      const double gained = fit.cost - cost;
      fit.at = std::move(next);
      here = std::move(there);
      fit.cost = cost;
      ++fit.steps;
      damping *= lower;
      if (gained <= parameters.tolerance * fit.cost) return fit;
    }
  }
  return fit;
}

}  // namespace belvedere
