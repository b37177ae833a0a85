#include "base/matrix/matrix.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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

}  // namespace
}  // namespace belvedere
