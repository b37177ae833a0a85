#include "terrain/register/pair_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/random.h"
#include "tests/terrain/register/synthetic_view.h"

namespace belvedere {
namespace {

// Exact pairs of a known view, clicked with 2 px, and a field of still ground.
PairFit exact_fit(std::size_t count) {
  PairFit fit;
  fit.pairs = test::synthetic_places(count);
  const test::SyntheticView view = test::synthetic_view(ViewKind::plane, fit.pairs);
  test::paint(view, fit.pairs);
  fit.frame = view.frame;
  fit.view = view.view;
  fit.noise_px.assign(count, glm::dvec2(2.0));
  fit.weights.assign(count, 1.0);
  fit.field = field_of_extent(fit.frame.extent_m, 0.12);
  fit.field.places = displaced_places(fit);
  return fit;
}

TEST(PairFit, AQuarterOfTheWeightIsTwiceTheNoise) {
  PairFit fit = exact_fit(20);
  const std::vector<DisplacedPlace> whole = displaced_places(fit);
  fit.weights[3] = 0.25;
  const std::vector<DisplacedPlace> quarter = displaced_places(fit);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const double factor = i == 3 ? 2.0 : 1.0;
    EXPECT_DOUBLE_EQ(quarter[i].noise.lateral_m, factor * whole[i].noise.lateral_m);
    EXPECT_DOUBLE_EQ(quarter[i].noise.upward_m, factor * whole[i].noise.upward_m);
    EXPECT_NEAR(whole[i].moved.lateral_m, 0.0, 1e-6);
  }
}

TEST(PairFit, APairIsJudgedByTheOthers) {
  PairFit fit = exact_fit(40);
  for (const double off : judge_pairs(fit, 2.0).others_px) EXPECT_NEAR(off, 0.0, 1e-3);
  fit.pairs[7].pixel += glm::dvec2(30.0, -40.0);
  fit.field.places = displaced_places(fit);
  const PairJudgement judged = judge_pairs(fit, 2.0);
  EXPECT_NEAR(judged.others_px[7], 50.0, 15.0);
  EXPECT_GT(judged.deviations[7], 5.0);
  double sum = 0.0;
  for (std::size_t i = 0; i < judged.scores.size(); ++i) {
    sum += judged.scores[i];
    EXPECT_GE(judged.scores[i], judged.scores[7]);
  }
  EXPECT_NEAR(judged.score, sum, 1e-9);
}

// Derivatives by a mountain's unknowns, by differences.
TEST(PairFit, AMountainMovesItsPairsAsItsSlopesSay) {
  PairFit fit = exact_fit(40);
  fit.mountains = {
      {{684000.0, 5255000.0}, fit.frame.extent_m, {0.2, -0.1, 0.8, 0.3, -0.2, 0.9, 0.5}}};
  const Residuals here = displacements(fit);
  ASSERT_EQ(here.slopes.columns(), view_unknown::count + MovedMountain::unknowns);
  std::size_t moved = 0;
  for (std::size_t k = 0; k < MovedMountain::unknowns; ++k) {
    constexpr double step = 1e-4;
    PairFit ahead = fit, behind = fit;
    ahead.mountains[0].at[k] += step;
    behind.mountains[0].at[k] -= step;
    const std::vector<double> a = displacements(ahead).values, b = displacements(behind).values;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double slope = (a[i] - b[i]) / (2.0 * step);
      EXPECT_NEAR(here.slopes(i, view_unknown::count + k), slope, 0.5 + 1e-3 * std::abs(slope));
      moved += std::abs(slope) > 10.0 ? 1 : 0;
    }
  }
  EXPECT_GT(moved, 20U);
}

// Six times as many pairs, at most half the variance.
TEST(PairFit, PairsMakeTheViewMoreCertain) {
  const PairFit few = exact_fit(10), many = exact_fit(60);
  for (const std::size_t i : {view_unknown::azimuth, view_unknown::log_focal}) {
    const double of_few = view_covariance(few, 2.0)(i, i);
    EXPECT_GT(of_few, 0.0);
    EXPECT_LT(view_covariance(many, 2.0)(i, i), 0.5 * of_few);
  }
}

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

// 20 pairs and as many places found in the paint, of still ground, all exact.
WeighedPairs exact() {
  WeighedPairs out;
  out.fit.pairs = test::synthetic_places(40);
  const test::SyntheticView view = test::synthetic_view(ViewKind::plane, out.fit.pairs);
  test::paint(view, out.fit.pairs);
  out.fit.frame = view.frame;
  out.fit.view = view.view;
  out.fit.noise_px.assign(40, glm::dvec2(2.0));
  out.fit.weights.assign(40, 1.0);
  out.fit.field = field_of_extent(out.fit.frame.extent_m, 0.12);
  for (std::size_t i = 0; i < 20; ++i) out.index.push_back(i);
  return out;
}

TEST(WeighedPairs, WeightsFallWithDeviations) {
  EXPECT_EQ(weight_of(0.0), 1.0);
  EXPECT_EQ(weight_of(2.0), 1.0);
  EXPECT_DOUBLE_EQ(weight_of(20.0), 0.25);
  EXPECT_EQ(weight_of(31.0), 0.01);
}

TEST(WeighedPairs, WrongOnesLoseTheirWeight) {
  WeighedPairs weighed = exact();
  weighed.fit.pairs[5].pixel += glm::dvec2(60.0, 0.0);
  weighed.fit.pairs[30].pixel += glm::dvec2(0.0, 60.0);
  weigh_by_agreement(weighed, 2.0, 4);
  EXPECT_GE(weighed.fit.weights[5], 0.25);
  EXPECT_LT(weighed.fit.weights[5], 0.7);
  EXPECT_LT(weighed.fit.weights[30], 0.3);
  EXPECT_EQ(weighed.fit.weights[12], 1.0);
  EXPECT_LT(weighed.judgement.scores[5], mean_score(weighed));
}

// More rounds are never less likely.
TEST(WeighedPairs, TheLikeliestRoundCounts) {
  double last = -1e9;
  for (const int rounds : {1, 2, 4}) {
    WeighedPairs weighed = exact();
    for (std::size_t i = 3; i < 40; i += 7) weighed.fit.pairs[i].pixel += glm::dvec2(12.0, -9.0);
    weigh_by_agreement(weighed, 2.0, rounds);
    EXPECT_GE(weighed.judgement.score, last) << rounds;
    last = weighed.judgement.score;
  }
}

constexpr double extent_m = 40000.0;

TEST(MovedMountain, NothingIsMovedByWhatIsExpected) {
  const DeformHandle handle = handle_of({{7000.0, 9000.0}, extent_m, {}});
  EXPECT_EQ(handle.centre, glm::dvec2(7000.0, 9000.0));
  EXPECT_DOUBLE_EQ(handle.radius_m, 4400.0);
  EXPECT_DOUBLE_EQ(handle.core_m, 1760.0);
  EXPECT_TRUE(HandleField({handle}).is_identity());
}

TEST(MovedMountain, UnknownsAreInStandardDeviations) {
  const DeformHandle handle =
      handle_of({{0.0, 0.0}, extent_m, {1.0, -1.0, 1.0, 0.01, -0.02, 2.0, -1.0}});
  EXPECT_EQ(handle.centre, glm::dvec2(1200.0, -1200.0));
  EXPECT_NEAR(handle.radius_m, 4400.0 * std::exp(0.35), 1e-9);
  EXPECT_NEAR(handle.move_m.x, 12.0, 0.01);
  EXPECT_NEAR(handle.move_m.y, -24.0, 0.01);
  EXPECT_DOUBLE_EQ(handle.rotate_deg, 50.0);
  EXPECT_DOUBLE_EQ(handle.raise_m, -200.0);
}

// Whatever a fit asks for: positions ahead of the core keep their order.
TEST(MovedMountain, NoMoveFoldsTheGround) {
  const DeformHandle handle = handle_of({{0.0, 0.0}, extent_m, {0.0, 0.0, 0.0, 100.0}});
  EXPECT_LT(glm::length(handle.move_m), (handle.radius_m - handle.core_m) / 1.9);
  const HandleField field({handle});
  double last = -1e9;
  for (double x = -5000.0; x < 5000.0; x += 20.0) {
    const double moved = field.move({x, 0.0}).position.x;
    EXPECT_GT(moved, last);
    last = moved;
  }
}

TEST(MovedMountain, CoresOfSeveralMustNotOverlap) {
  const MovedMountain one{{0.0, 0.0}, extent_m, {}};
  const auto two_at = [&](double distance) {
    return handles_of(std::vector{one, MovedMountain{{distance, 0.0}, extent_m, {}}});
  };
  EXPECT_FALSE(are_apart(two_at(3500.0)));
  EXPECT_TRUE(are_apart(two_at(3600.0)));
  EXPECT_NO_THROW(HandleField(two_at(3600.0)));
}

}  // namespace
}  // namespace belvedere
