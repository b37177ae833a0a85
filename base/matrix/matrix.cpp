#include "base/matrix/matrix.h"

#include <cmath>
#include <utility>

namespace belvedere {
namespace {

// Each column of a, as a row of its own, changed in place.
template <class Change>
Matrix by_columns(const Matrix& a, const Change& change) {
  Matrix columns = transposed(a);
  for (std::size_t i = 0; i < columns.rows(); ++i) change(columns.row(i));
  return transposed(columns);
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

std::optional<Cholesky> Cholesky::of(Matrix a) {
  const std::size_t n = a.rows();
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = k; i < n; ++i) {
      double sum = a(i, k);
      for (std::size_t j = 0; j < k; ++j) sum -= a(i, j) * a(k, j);
      if (i == k) {
        if (!(sum > 0.0) || !std::isfinite(sum)) return std::nullopt;
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
  for (std::size_t i = 0; i < x.size(); ++i) {
    double sum = x[i];
    for (std::size_t k = 0; k < i; ++k) sum -= lower_(i, k) * x[k];
    x[i] = sum / lower_(i, i);
  }
}

void Cholesky::substitute_back(std::span<double> x) const {
  for (std::size_t i = x.size(); i-- > 0;) {
    x[i] /= lower_(i, i);
    for (std::size_t k = 0; k < i; ++k) x[k] -= lower_(i, k) * x[i];
  }
}

std::vector<double> Cholesky::whitened(std::span<const double> x) const {
  std::vector<double> out(x.begin(), x.end());
  substitute_forward(out);
  return out;
}

Matrix Cholesky::whitened(const Matrix& a) const {
  return by_columns(a, [&](std::span<double> column) { substitute_forward(column); });
}

std::vector<double> Cholesky::solve(std::span<const double> x) const {
  std::vector<double> out = whitened(x);
  substitute_back(out);
  return out;
}

Matrix Cholesky::solve(const Matrix& a) const {
  return by_columns(a, [&](std::span<double> column) {
    substitute_forward(column);
    substitute_back(column);
  });
}

Matrix Cholesky::inverse() const {
  Matrix unit(lower_.rows(), lower_.rows());
  for (std::size_t i = 0; i < unit.rows(); ++i) unit(i, i) = 1.0;
  return solve(unit);
}

}  // namespace belvedere
