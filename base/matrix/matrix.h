#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"

namespace belvedere {

// A small dense matrix of doubles, by rows, for problems with up to a few hundred unknowns. Plain
// loops in a fixed order, so results have the same bits on every machine.
class Matrix {
 public:
  Matrix() = default;
  Matrix(std::size_t rows, std::size_t columns, double value = 0.0)
      : rows_(rows), columns_(columns), values_(rows * columns, value) {}

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  double& operator()(std::size_t row, std::size_t column) {
    return values_[row * columns_ + column];
  }
  double operator()(std::size_t row, std::size_t column) const {
    return values_[row * columns_ + column];
  }
  std::span<double> row(std::size_t row) {
    return std::span(values_).subspan(row * columns_, columns_);
  }
  std::span<const double> row(std::size_t row) const {
    return std::span(values_).subspan(row * columns_, columns_);
  }

 private:
  std::size_t rows_ = 0;
  std::size_t columns_ = 0;
  std::vector<double> values_;
};

Matrix transposed(const Matrix& a);
Matrix product(const Matrix& a, const Matrix& b);
std::vector<double> product(const Matrix& a, std::span<const double> x);
// aᵀ a and aᵀ x.
Matrix normal_matrix(const Matrix& a);
std::vector<double> product_transposed(const Matrix& a, std::span<const double> x);

// A symmetric positive definite matrix as L Lᵀ, L lower triangular, for solving equations with it.
class Cholesky {
 public:
  // Reads the lower triangle. Nothing if the matrix is not positive definite to working precision,
  // or if an unknown adds to those before it no more than `min_share` of its diagonal entry.
  static std::optional<Cholesky> of(Matrix a, double min_share = 0.0);

  // L⁻¹ x: uncorrelated and of deviation 1 if the matrix is the covariance of x.
  std::vector<double> whitened(std::span<const double> x) const;
  // L⁻¹ times each column.
  Matrix whitened(const Matrix& a) const;
  // The matrix's inverse times x, or times each column.
  std::vector<double> solve(std::span<const double> x) const;
  Matrix solve(const Matrix& a) const;
  Matrix inverse() const;

 private:
  explicit Cholesky(Matrix lower) : lower_(static_cast<Matrix&&>(lower)) {}
  void substitute_forward(std::span<double> x) const;
  void substitute_back(std::span<double> x) const;

  Matrix lower_;
};

// Residuals at some values of the unknowns, and their derivatives: a row a residual, a column an
// unknown.
struct Residuals {
  std::vector<double> values;
  Matrix slopes;
};
using ResidualFunction = FunctionRef<Residuals(std::span<const double> at)>;

struct LeastSquaresParameters {
  int max_steps = 60;        // ≥ 1
  double tolerance = 1e-10;  // stops when a step gains less than this share of the cost, ≥ 0
  std::size_t robust = 0;    // so many residuals, from the first, count as ln(1 + r²) (Cauchy)
};
struct LeastSquaresFit {
  std::vector<double> at;
  double cost = 0.0;  // half the sum of r², or of ln(1 + r²)
  int steps = 0;      // taken
};

// The unknowns with the least cost near `start`: Levenberg-Marquardt with Marquardt's scaling of
// each unknown, and iterated weights 1 / (1 + r²) for the robust residuals. Values that are not
// finite are steps that went too far.
LeastSquaresFit fit_least_squares(std::vector<double> start, ResidualFunction function,
                                  const LeastSquaresParameters& parameters = {});

// Symmetric 3 × 3 matrices, such as covariances of colours.

struct SymmetricEigen {
  glm::dvec3 values{0.0};   // unsorted
  glm::dmat3 vectors{1.0};  // columns of length 1
};
// By Jacobi rotations.
SymmetricEigen symmetric_eigen(glm::dmat3 a);

struct GainLimits {
  double min;
  double max;
};
// Optimal linear transport (Monge–Kantorovich) of colours of covariance A to those of covariance B:
// A^-½ (A^½ B A^½)^½ A^-½, symmetric and positive (Pitié & Kokaram 2007), with eigenvalues clamped
// to the limits. `floor` is added to all variances, which limits the amplification of noise.
glm::dmat3 linear_transport_map(const glm::dmat3& from, const glm::dmat3& to, double floor,
                                GainLimits gain);

}  // namespace belvedere
