#include "terrain/register/pair_fit.h"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace belvedere
