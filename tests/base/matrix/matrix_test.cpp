#include "base/matrix/matrix.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "terrain/register/view_model.h"

namespace belvedere {
namespace {

// Of (3, 2, 1)ᵀ (3, 2, 1) and a diagonal: positive definite.
Matrix example() {
  Matrix a(3, 3);
  const double v[] = {3.0, 2.0, 1.0};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) a(i, k) = v[i] * v[k];
    a(i, i) += static_cast<double>(i) + 1.0;
  }
  return a;
}

TEST(Matrix, ProductsAreThoseOfThePaper) {
  Matrix a(2, 3);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      a(i, k) = 10.0 * static_cast<double>(i) + static_cast<double>(k);
  const Matrix square = normal_matrix(a);
  const Matrix other = product(transposed(a), a);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(square(i, k), other(i, k));
  EXPECT_EQ(square(1, 2), 1.0 * 2.0 + 11.0 * 12.0);
  EXPECT_EQ(product(a, std::vector{1.0, 2.0, 3.0}), (std::vector{8.0, 68.0}));
  EXPECT_EQ(product_transposed(a, std::vector{1.0, 2.0}), (std::vector{20.0, 23.0, 26.0}));
}

TEST(Matrix, CholeskySolvesAndInverts) {
  const Matrix a = example();
  const auto factors = Cholesky::of(a);
  ASSERT_TRUE(factors);
  const std::vector<double> x{1.0, -2.0, 0.5};
  const std::vector<double> solved = factors->solve(product(a, x));
  const Matrix unit = product(a, factors->inverse());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(solved[i], x[i], 1e-13);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(unit(i, k), i == k ? 1.0 : 0.0, 1e-13);
  }
}

TEST(Matrix, WhiteningMakesTheCovarianceTheUnit) {
  const Matrix a = example();
  const auto factors = Cholesky::of(a);
  ASSERT_TRUE(factors);
  // L⁻¹ A L⁻ᵀ.
  const Matrix white = factors->whitened(transposed(factors->whitened(a)));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(white(i, k), i == k ? 1.0 : 0.0, 1e-14);
  EXPECT_NEAR(factors->whitened(std::vector{2.0, 0.0, 0.0})[0], 2.0 / std::sqrt(10.0), 1e-15);
}

TEST(Matrix, WhatIsNotPositiveDefiniteHasNoFactors) {
  Matrix a = example();
  a(2, 2) = -1.0;
  EXPECT_FALSE(Cholesky::of(a));
  a(2, 2) = std::nan("");
  EXPECT_FALSE(Cholesky::of(a));
}

TEST(Matrix, UnknownsThatFollowFromOthersHaveNoFactors) {
  Matrix a(2, 2, 1.0);
  a(1, 1) = 1.0 + 1e-10;
  EXPECT_TRUE(Cholesky::of(a));
  EXPECT_FALSE(Cholesky::of(a, 1e-9));
  a(1, 1) = 1.0 + 1e-8;
  EXPECT_TRUE(Cholesky::of(a, 1e-9));
}

using Two = Dual<2>;

TEST(Dual, DerivativesAreThoseOfTheFormula) {
  const auto formula = [](auto x, auto y) {
    return sqrt(x * x + y) / exp(y) + log(x) * sin(x * y) - cos(y) + atan2(y, x) - x;
  };
  const double x = 1.3, y = 0.7, h = 1e-6;
  const Two f = formula(Two::unknown(x, 0), Two::unknown(y, 1));
  const auto value = [&](double at_x, double at_y) { return formula(Two(at_x), Two(at_y)).value; };
  EXPECT_NEAR(f.value,
              std::sqrt(x * x + y) / std::exp(y) + std::log(x) * std::sin(x * y) - std::cos(y) +
                  std::atan2(y, x) - x,
              1e-14);
  EXPECT_NEAR(f.slope[0], (value(x + h, y) - value(x - h, y)) / (2.0 * h), 1e-9);
  EXPECT_NEAR(f.slope[1], (value(x, y + h) - value(x, y - h)) / (2.0 * h), 1e-9);
}

Residuals residuals_of(std::span<const Two> rows) {
  Residuals out{std::vector<double>(rows.size()), Matrix(rows.size(), 2)};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out.values[i] = rows[i].value;
    for (std::size_t k = 0; k < 2; ++k) out.slopes(i, k) = rows[i].slope[k];
  }
  return out;
}

// One residual that nothing can change: half its square, or half the logarithm that robust ones
// have.
TEST(LeastSquares, TheCostIsHalfTheSum) {
  const auto apart = [](std::span<const double> at) {
    return residuals_of(std::array{Two(2.0), Two::unknown(at[0], 0), Two::unknown(at[1], 1)});
  };
  EXPECT_NEAR(fit_least_squares({3.0, -1.0}, apart).cost, 2.0, 1e-12);
  EXPECT_NEAR(fit_least_squares({3.0, -1.0}, apart, {.robust = 1}).cost, 0.5 * std::log(5.0),
              1e-12);
}

// Rosenbrock's valley as two residuals; its least cost, 0, is at (1, 1).
TEST(LeastSquares, FollowsACurvedValleyToItsEnd) {
  const auto valley = [](std::span<const double> at) {
    const Two x = Two::unknown(at[0], 0);
    const Two y = Two::unknown(at[1], 1);
    return residuals_of(std::array{Two(10.0) * (y - x * x), Two(1.0) - x});
  };
  const LeastSquaresFit fit = fit_least_squares({-1.2, 1.0}, valley);
  EXPECT_NEAR(fit.at[0], 1.0, 1e-8);
  EXPECT_NEAR(fit.at[1], 1.0, 1e-8);
  EXPECT_LT(fit.cost, 1e-16);
  EXPECT_LE(fit.steps, 40);
}

// A line through 19 points with three far off.
TEST(LeastSquares, RobustResidualsIgnoreWhatLiesFarOff) {
  const auto line = [](std::span<const double> at) {
    const Two level = Two::unknown(at[0], 0);
    const Two slope = Two::unknown(at[1], 1);
    std::vector<Two> rows;
    for (int i = 0; i < 19; ++i) {
      const double x = 0.5 * i;
      const double y = 2.0 + 3.0 * x + (i % 7 == 3 ? 400.0 : 0.0);
      rows.push_back((level + slope * Two(x) - Two(y)) / Two(0.1));
    }
    return residuals_of(rows);
  };
  const LeastSquaresFit robust = fit_least_squares({0.0, 2.0}, line, {.robust = 19});
  EXPECT_NEAR(robust.at[0], 2.0, 1e-3);
  EXPECT_NEAR(robust.at[1], 3.0, 1e-3);
  const LeastSquaresFit plain = fit_least_squares({0.0, 2.0}, line);
  EXPECT_GT(std::abs(plain.at[0] - 2.0), 10.0);
}

TEST(LeastSquares, AnUnknownWithoutEffectKeepsItsValue) {
  const auto function = [](std::span<const double> at) {
    return residuals_of(std::array{Two::unknown(at[0], 0) - Two(4.0)});
  };
  const LeastSquaresFit fit = fit_least_squares({1.0, 7.0}, function);
  EXPECT_NEAR(fit.at[0], 4.0, 1e-9);
  EXPECT_EQ(fit.at[1], 7.0);
}

glm::dmat3 symmetric(double xx, double xy, double xz, double yy, double yz, double zz) {
  return {{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}};
}

TEST(SymmetricEigen, VectorsAreTurnedIntoTheirMultiples) {
  const glm::dmat3 a = symmetric(4.0, 1.0, -0.5, 3.0, 0.7, 2.0);
  const SymmetricEigen eigen = symmetric_eigen(a);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(glm::length(eigen.vectors[k]), 1.0, 1e-12);
    EXPECT_LT(glm::length(a * eigen.vectors[k] - eigen.values[k] * eigen.vectors[k]), 1e-12);
  }
}

TEST(SymmetricEigen, KnownValues) {
  // [2 1; 1 2] has 1 and 3.
  const SymmetricEigen eigen = symmetric_eigen(symmetric(2.0, 1.0, 0.0, 2.0, 0.0, 5.0));
  std::array<double, 3> values = {eigen.values.x, eigen.values.y, eigen.values.z};
  std::sort(values.begin(), values.end());
  EXPECT_NEAR(values[0], 1.0, 1e-12);
  EXPECT_NEAR(values[1], 3.0, 1e-12);
  EXPECT_NEAR(values[2], 5.0, 1e-12);
}

TEST(LeastMovingMap, TakesOneCovarianceToTheOther) {
  const glm::dmat3 from = symmetric(0.04, 0.01, 0.0, 0.02, 0.003, 0.01);
  const glm::dmat3 to = symmetric(0.02, -0.004, 0.001, 0.03, 0.0, 0.02);
  const glm::dmat3 map = linear_transport_map(from, to, 0.0, {0.01, 100.0});
  const glm::dmat3 got = map * from * glm::transpose(map);
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) {
      EXPECT_NEAR(got[c][r], to[c][r], 1e-12);
      EXPECT_NEAR(map[c][r], map[r][c], 1e-12);
    }
}

TEST(LeastMovingMap, KeepsItsGainsWithinTheLimits) {
  const glm::dmat3 map = linear_transport_map(symmetric(1, 0, 0, 1, 0, 1),
                                              symmetric(100, 0, 0, 1, 0, 0.01), 0.0, {0.5, 2.0});
  EXPECT_NEAR(map[0][0], 2.0, 1e-9);
  EXPECT_NEAR(map[1][1], 1.0, 1e-9);
  EXPECT_NEAR(map[2][2], 0.5, 1e-9);
}

}  // namespace

}  // namespace belvedere
