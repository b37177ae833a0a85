#include "terrain/register/weighed_pairs.h"

#include <gtest/gtest.h>

#include "tests/terrain/register/synthetic_view.h"

namespace belvedere {
namespace {

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

}  // namespace
}  // namespace belvedere
