#include "terrain/register/leave_out.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <optional>

#include "base/random.h"

namespace belvedere {
namespace {

// A line through ten observations with correlated noise, and a prior for its two unknowns.
struct Line {
  Matrix covariance{10, 10};
  Matrix slopes{10, 2};
  Matrix precision{2, 2};
  std::vector<double> prior_mean{0.7, -0.2};
  std::vector<double> observed;

  Line() {
    for (std::size_t i = 0; i < 10; ++i) {
      const double x = static_cast<double>(i);
      slopes(i, 0) = 1.0;
      slopes(i, 1) = x;
      observed.push_back(3.0 + 0.5 * x + random_normal(1, static_cast<int>(i), 0));
      for (std::size_t k = 0; k < 10; ++k)
        covariance(i, k) = 0.8 * std::exp(-std::abs(x - static_cast<double>(k)) / 2.0);
      covariance(i, i) += 0.3 + 0.05 * x;
    }
    precision(0, 0) = 0.5;
    precision(1, 1) = 4.0;
    precision(0, 1) = precision(1, 0) = 0.2;
  }

  // The most likely unknowns by some of the observations.
  std::vector<double> fitted(const std::vector<std::size_t>& used) const {
    const Matrix design = rows(slopes, used);
    const Cholesky noise = *Cholesky::of(block(covariance, used, used));
    Matrix normal = product(transposed(design), noise.solve(design));
    std::vector<double> right = product_transposed(design, noise.solve(picked(observed, used)));
    const std::vector<double> prior = product(precision, prior_mean);
    for (std::size_t i = 0; i < 2; ++i) {
      right[i] += prior[i];
      for (std::size_t k = 0; k < 2; ++k) normal(i, k) += precision(i, k);
    }
    return Cholesky::of(normal)->solve(right);
  }

  std::vector<double> residuals(const std::vector<double>& at) const {
    std::vector<double> out = product(slopes, at);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = observed[i] - out[i];
    return out;
  }

  static std::vector<double> picked(const std::vector<double>& from,
                                    const std::vector<std::size_t>& used) {
    std::vector<double> out;
    for (const std::size_t i : used) out.push_back(from[i]);
    return out;
  }
  static Matrix block(const Matrix& from, const std::vector<std::size_t>& a,
                      const std::vector<std::size_t>& b) {
    Matrix out(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t k = 0; k < b.size(); ++k) out(i, k) = from(a[i], b[k]);
    return out;
  }
  static Matrix rows(const Matrix& from, const std::vector<std::size_t>& used) {
    Matrix out(used.size(), from.columns());
    for (std::size_t i = 0; i < used.size(); ++i)
      for (std::size_t k = 0; k < from.columns(); ++k) out(i, k) = from(used[i], k);
    return out;
  }
};

TEST(LeaveOut, EqualsFittingWithoutTheGroup) {
  const Line line;
  const std::vector<std::size_t> all = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  const std::vector<std::vector<std::size_t>> groups = {{0}, {3, 7}, {9}, {1, 2, 8}};
  const std::vector<LeftOut> left = leave_out(line.covariance, line.slopes, line.precision,
                                              line.residuals(line.fitted(all)), groups);
  ASSERT_EQ(left.size(), groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::vector<std::size_t> others;
    for (const std::size_t i : all)
      if (std::find(groups[g].begin(), groups[g].end(), i) == groups[g].end()) others.push_back(i);
    const std::vector<double> residuals = line.residuals(line.fitted(others));
    // The others' noise tells part of the group's.
    const Cholesky noise = *Cholesky::of(Line::block(line.covariance, others, others));
    const std::vector<double> told = product(Line::block(line.covariance, groups[g], others),
                                             noise.solve(Line::picked(residuals, others)));
    for (std::size_t k = 0; k < groups[g].size(); ++k)
      EXPECT_NEAR(left[g].residuals[k], residuals[groups[g][k]] - told[k], 1e-10);
    // By the whole covariance of the observations, the unknowns' prior in it.
    Matrix whole = product(product(line.slopes, Cholesky::of(line.precision)->inverse()),
                           transposed(line.slopes));
    for (const std::size_t i : all)
      for (const std::size_t k : all) whole(i, k) += line.covariance(i, k);
    const Matrix across = Line::block(whole, groups[g], others);
    const Matrix known = product(
        across, Cholesky::of(Line::block(whole, others, others))->solve(transposed(across)));
    for (std::size_t i = 0; i < groups[g].size(); ++i)
      for (std::size_t k = 0; k < groups[g].size(); ++k)
        EXPECT_NEAR(left[g].covariance(i, k), whole(groups[g][i], groups[g][k]) - known(i, k),
                    1e-9);
  }
}

}  // namespace
}  // namespace belvedere
