#include "base/matrix/matrix.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <utility>

#include "base/math_exact.h"

namespace belvedere {
namespace {

// Each column of a, as a row of its own, changed in place.
template <class Change>
Matrix by_columns(const Matrix& a, const Change& change) {
  Matrix columns = transposed(a);
  for (std::size_t i = 0; i < columns.rows(); ++i) change(columns.row(i));
  return transposed(columns);
}

// The first entry of each row of a lower triangle that is not 0: blocks without covariance cost
// nothing.
std::vector<std::size_t> first_entries(const Matrix& a) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < a.rows(); ++i) {
    const std::span<const double> row = a.row(i).first(i + 1);
    const auto found = std::find_if(row.begin(), row.end(), [](double v) { return v != 0.0; });
    out.push_back(static_cast<std::size_t>(found - row.begin()));
  }
  return out;
}

void forward(const Matrix& lower, const std::vector<std::size_t>& first, std::span<double> x) {
  std::size_t from = 0;
  while (from < x.size() && x[from] == 0.0) ++from;
  for (std::size_t i = from; i < x.size(); ++i) {
    double sum = x[i];
    for (std::size_t k = std::max(first[i], from); k < i; ++k) sum -= lower(i, k) * x[k];
    x[i] = sum / lower(i, i);
  }
}

void back(const Matrix& lower, const std::vector<std::size_t>& first, std::span<double> x) {
  for (std::size_t i = x.size(); i-- > 0;) {
    x[i] /= lower(i, i);
    for (std::size_t k = first[i]; k < i; ++k) x[k] -= lower(i, k) * x[i];
  }
}

}  // namespace

Matrix transposed(const Matrix& a) {
  Matrix out(a.columns(), a.rows());
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t k = 0; k < a.columns(); ++k) out(k, i) = a(i, k);
  return out;
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix out(a.rows(), b.columns());
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t j = 0; j < a.columns(); ++j)
      for (std::size_t k = 0; k < b.columns(); ++k) out(i, k) += a(i, j) * b(j, k);
  return out;
}

std::vector<double> product(const Matrix& a, std::span<const double> x) {
  std::vector<double> out(a.rows(), 0.0);
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t k = 0; k < a.columns(); ++k) out[i] += a(i, k) * x[k];
  return out;
}

Matrix normal_matrix(const Matrix& a) {
  Matrix out(a.columns(), a.columns());
  for (std::size_t row = 0; row < a.rows(); ++row)
    for (std::size_t i = 0; i < a.columns(); ++i)
      for (std::size_t k = 0; k <= i; ++k) out(i, k) += a(row, i) * a(row, k);
  for (std::size_t i = 0; i < a.columns(); ++i)
    for (std::size_t k = 0; k < i; ++k) out(k, i) = out(i, k);
  return out;
}

std::vector<double> product_transposed(const Matrix& a, std::span<const double> x) {
  std::vector<double> out(a.columns(), 0.0);
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t k = 0; k < a.columns(); ++k) out[k] += a(i, k) * x[i];
  return out;
}

std::optional<Cholesky> Cholesky::of(Matrix a, double min_share) {
  const std::size_t n = a.rows();
  const std::vector<std::size_t> first = first_entries(a);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = k; i < n; ++i) {
      double sum = a(i, k);
      for (std::size_t j = std::max(first[i], first[k]); j < k; ++j) sum -= a(i, j) * a(k, j);
      if (i == k) {
        if (!(sum > min_share * a(k, k)) || !std::isfinite(sum)) return std::nullopt;
        a(k, k) = std::sqrt(sum);
      } else {
        a(i, k) = sum / a(k, k);
        a(k, i) = 0.0;
      }
    }
  }
  return Cholesky(std::move(a));
}

void Cholesky::substitute_forward(std::span<double> x) const {
  forward(lower_, first_entries(lower_), x);
}

void Cholesky::substitute_back(std::span<double> x) const {
  back(lower_, first_entries(lower_), x);
}

std::vector<double> Cholesky::whitened(std::span<const double> x) const {
  std::vector<double> out(x.begin(), x.end());
  substitute_forward(out);
  return out;
}

Matrix Cholesky::whitened(const Matrix& a) const {
  const std::vector<std::size_t> first = first_entries(lower_);
  return by_columns(a, [&](std::span<double> column) { forward(lower_, first, column); });
}

std::vector<double> Cholesky::solve(std::span<const double> x) const {
  std::vector<double> out = whitened(x);
  substitute_back(out);
  return out;
}

Matrix Cholesky::solve(const Matrix& a) const {
  const std::vector<std::size_t> first = first_entries(lower_);
  return by_columns(a, [&](std::span<double> column) {
    forward(lower_, first, column);
    back(lower_, first, column);
  });
}

Matrix Cholesky::inverse() const {
  Matrix unit(lower_.rows(), lower_.rows());
  for (std::size_t i = 0; i < unit.rows(); ++i) unit(i, i) = 1.0;
  return solve(unit);
}

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

namespace {

// Applies f to the eigenvalues of a symmetric matrix.
template <class F>
glm::dmat3 spectral(const glm::dmat3& a, F f) {
  const SymmetricEigen eigen = symmetric_eigen(a);
  glm::dmat3 scale(0.0);
  for (int k = 0; k < 3; ++k) scale[k][k] = f(eigen.values[k]);
  return eigen.vectors * scale * glm::transpose(eigen.vectors);
}

glm::dmat3 root(const glm::dmat3& a) {
  return spectral(a, [](double v) { return std::sqrt(std::max(v, 0.0)); });
}

}  // namespace

SymmetricEigen symmetric_eigen(glm::dmat3 a) {
  SymmetricEigen out;
  for (int sweep = 0; sweep < 12; ++sweep)
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (std::abs(a[q][p]) < 1e-18) continue;
        const double theta = (a[q][q] - a[p][p]) / (2.0 * a[q][p]);
        const double t =
            (theta >= 0.0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
        const double c = 1.0 / std::sqrt(t * t + 1.0);
        glm::dmat3 turn(1.0);
        turn[p][p] = turn[q][q] = c;
        turn[q][p] = c * t;
        turn[p][q] = -c * t;
        a = glm::transpose(turn) * a * turn;
        out.vectors = out.vectors * turn;
      }
  out.values = {a[0][0], a[1][1], a[2][2]};
  return out;
}

glm::dmat3 linear_transport_map(const glm::dmat3& from, const glm::dmat3& to, double floor,
                                GainLimits gain) {
  const glm::dmat3 least(floor);
  const glm::dmat3 half = root(from + least);
  const glm::dmat3 inverse = glm::inverse(half);
  const glm::dmat3 map = inverse * root(half * (to + least) * half) * inverse;
  return spectral(map, [&](double v) { return std::clamp(v, gain.min, gain.max); });
}

}  // namespace belvedere
