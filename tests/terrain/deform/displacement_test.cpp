#include "terrain/deform/displacement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/random.h"
#include "tests/files.h"

namespace belvedere {
namespace {

// Five places, two of which moved.
DisplacementParameters example(double noise_m) {
  const Displacement noise{noise_m, noise_m};
  return {.length_m = 4000.0,
          .reach_m = 2000.0,
          .still_m = 20.0,
          .max_m = 1500.0,
          .places = {{{0.0, 0.0}, {400.0, -200.0}, noise},
                     {{1500.0, 500.0}, {300.0, -100.0}, noise},
                     {{12000.0, 0.0}, {5.0, 3.0}, noise},
                     {{9000.0, 9000.0}, {-4.0, 0.0}, noise},
                     {{0.0, 14000.0}, {0.0, 6.0}, noise}}};
}

TEST(Displacement, InterpolatesWithoutNoise) {
  const DisplacementField field(example(1e-4));
  for (const DisplacedPlace& place : field.parameters().places) {
    const Displacement at = field.at(place.position);
    EXPECT_NEAR(at.lateral_m, place.moved.lateral_m, 1e-3);
    EXPECT_NEAR(at.upward_m, place.moved.upward_m, 1e-3);
    EXPECT_LT(field.deviation(place.position).lateral_m, 1e-3);
  }
}

TEST(Displacement, NoiseIsNotFollowed) {
  const DisplacementField field(example(100.0));
  const Displacement at = field.at({12000.0, 0.0});
  EXPECT_LT(std::abs(at.lateral_m), 2.5);
  EXPECT_NEAR(field.at({0.0, 0.0}).lateral_m, 400.0, 60.0);
}

TEST(Displacement, OnePlaceHasTheClosedForm) {
  DisplacementParameters one = example(50.0);
  one.places.resize(1);
  const DisplacementField field(one);
  // m² = (400² + 200²) / 2 - (1.5 · 50)²; at the place itself w = 1.
  const double m2 = 100000.0 - 5625.0;
  const double here = std::sqrt(400.0 + m2 / 1.15);
  EXPECT_NEAR(displacement_size_m(one, {0.0, 0.0}), here, 1e-9);
  EXPECT_NEAR(displacement_size_m(one, {0.0, 0.0}, 0), 20.0, 1e-12);
  const double w = std::exp(-0.5 * 0.25);
  const double there = std::sqrt(400.0 + w * m2 / (0.15 + w));
  const double t = std::sqrt(3.0) * 0.25;
  const double covariance = here * there * (1.0 + t) * std::exp(-t);
  const double whole = here * here + 2500.0;
  EXPECT_NEAR(field.at({0.0, 1000.0}).lateral_m, covariance / whole * 400.0, 1e-9);
  EXPECT_NEAR(field.at({0.0, 1000.0}).upward_m, covariance / whole * -200.0, 1e-9);
  EXPECT_NEAR(field.deviation({0.0, 1000.0}).upward_m,
              std::sqrt(there * there - covariance * covariance / whole), 1e-9);
}

TEST(Displacement, FarAwayNothingMovesAndOnlyStillnessIsKnown) {
  const DisplacementField field(example(10.0));
  EXPECT_EQ(field.at({500000.0, 0.0}).lateral_m, 0.0);
  EXPECT_EQ(field.deviation({500000.0, 0.0}).upward_m, 20.0);
  EXPECT_TRUE(DisplacementField().is_identity());
  EXPECT_EQ(DisplacementField().at({0.0, 0.0}).upward_m, 0.0);
  EXPECT_EQ(DisplacementField().deviation({0.0, 0.0}).lateral_m, 0.0);
}

// Many places are tabulated: finely near them, coarsely farther away, and beyond that nothing
// moves.
TEST(Displacement, OfManyPlacesIsWithinTwoThousandthsOfTheExactOne) {
  DisplacementParameters p = example(10.0);
  for (int i = 0; i < 30; ++i)
    p.places.push_back({{400.0 * i, 9000.0 * random_uniform(1, 0, i)},
                        {800.0 * random_uniform(2, 0, i) - 400.0, 60.0},
                        {20.0, 20.0}});
  const DisplacementField field(p);
  double worst = 0.0, largest = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double reach = i < 3000 ? 1.0 : 4.0;
    const glm::dvec2 at = glm::dvec2(5000.0, 5000.0) +
                          reach * glm::dvec2(40000.0 * random_uniform(3, 0, i) - 20000.0,
                                             50000.0 * random_uniform(4, 0, i) - 25000.0);
    const Displacement exact = field.exactly_at(at), quick = field.at(at);
    worst = std::max({worst, std::abs(exact.lateral_m - quick.lateral_m),
                      std::abs(exact.upward_m - quick.upward_m)});
    largest = std::max(largest, std::abs(exact.lateral_m));
  }
  EXPECT_GT(largest, 200.0);
  EXPECT_GT(worst, 0.0);
  EXPECT_LT(worst, 2e-3 * largest);
}

TEST(Displacement, TheSizeIsLimited) {
  DisplacementParameters p = example(10.0);
  p.places[0].moved.lateral_m = 90000.0;
  EXPECT_LE(displacement_size_m(p, {0.0, 0.0}), std::sqrt(1500.0 * 1500.0 + 400.0));
}

TEST(Displacement, RefusesWhatHasNoMeaning) {
  const auto refused = [](auto&& change) {
    DisplacementParameters p = example(10.0);
    change(p);
    return std::string(test::error_of([&] { DisplacementField{p}; }).what());
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(refused([](auto& p) { p.length_m = 0.0; }), HasSubstr("length_m: 0"));
  EXPECT_THAT(refused([](auto& p) { p.still_m = -1.0; }), HasSubstr("still_m: -1"));
  EXPECT_THAT(refused([](auto& p) { p.places[2].noise.upward_m = 0.0; }), HasSubstr("places.2"));
  EXPECT_THAT(refused([](auto& p) { p.places[1].moved.lateral_m = std::nan(""); }),
              HasSubstr("places.1"));
}

}  // namespace
}  // namespace belvedere
