#include "terrain/register/find_mountains.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "base/random.h"
#include "tests/terrain/register/synthetic_view.h"

namespace belvedere {
namespace {

// Turned by 40°, moved by 900 m and raised.
const DeformHandle turned{.centre = {684000.0, 5255000.0},
                          .move_m = {700.0, -500.0},
                          .rotate_deg = 40.0,
                          .raise_m = 150.0,
                          .radius_m = 4500.0,
                          .core_m = 1800.0};

// Pairs of ground that handles moved, and so many more on the core; clicked with that noise.
WeighedPairs painted(const std::vector<DeformHandle>& handles, std::size_t on_core,
                     double sigma_px) {
  WeighedPairs out;
  PairFit& fit = out.fit;
  fit.pairs = test::synthetic_places(70);
  for (std::size_t i = 0; i < on_core; ++i) {
    const double angle = 1.2566 * static_cast<double>(i);
    fit.pairs.push_back(fit.pairs[i]);
    fit.pairs.back().position =
        turned.centre + 1500.0 * glm::dvec2(std::cos(angle), std::sin(angle));
  }
  const test::SyntheticView view = test::synthetic_view(ViewKind::plane, fit.pairs);
  const HandleField field(handles);
  for (std::size_t i = 0; i < fit.pairs.size(); ++i) {
    const auto n = static_cast<std::int64_t>(i);
    fit.pairs[i].pixel = test::pixel_of(view, moved_by(field, fit.pairs[i]));
    fit.pairs[i].pixel += sigma_px * glm::dvec2(random_normal(3, n, 0), random_normal(3, n, 1));
    out.index.push_back(i);
  }
  fit.frame = view.frame;
  fit.view = view.view;
  fit.noise_px.assign(fit.pairs.size(), glm::dvec2(2.0));
  fit.weights.assign(fit.pairs.size(), 1.0);
  fit.field = field_of_extent(fit.frame.extent_m, 0.12);
  weigh_by_agreement(out, 2.0, 2);
  return out;
}

// The mean distance of ground in the core from where the turned mountain is painted, px. Ground
// that is moved away from the viewer and ground that is raised look alike.
double off_px(const PairFit& fit, const std::vector<MovedMountain>& mountains) {
  const HandleField found(handles_of(mountains)), truth({turned});
  const test::SyntheticView view{fit.frame, fit.view};
  double sum = 0.0;
  for (int i = 0; i < 12; ++i) {
    ControlPair place{.altitude_m = 1500.0};
    place.position =
        turned.centre + 1200.0 * glm::dvec2(std::cos(0.5236 * i), std::sin(0.5236 * i));
    sum += glm::length(test::pixel_of(view, moved_by(found, place)) -
                       test::pixel_of(view, moved_by(truth, place)));
  }
  return sum / 12.0;
}

TEST(FindMountains, FiveExactPairsTellHowAMountainWasTurnedAndMoved) {
  const WeighedPairs pairs = painted({turned}, 5, 0.0);
  const std::vector<MovedMountain> proposed = propose_mountains(pairs.fit);
  ASSERT_FALSE(proposed.empty());
  EXPECT_NEAR(handle_of(proposed.front()).rotate_deg, turned.rotate_deg, 6.0);
  const HandleField found({handle_of(proposed.front())}), truth({turned});
  // Across the line of sight.
  EXPECT_NEAR(found.move(turned.centre).position.x, truth.move(turned.centre).position.x, 60.0);
  EXPECT_GT(off_px(pairs.fit, {}), 20.0);
  EXPECT_LT(off_px(pairs.fit, {proposed.front()}), 3.0);
}

TEST(FindMountains, AMountainIsTakenIfTheOthersTellAllTheBetter) {
  WeighedPairs pairs = painted({turned}, 5, 2.0);
  const double before = pairs.judgement.score;
  move_mountains(pairs, 2.0);
  ASSERT_EQ(pairs.fit.mountains.size(), 1U);
  EXPECT_GT(pairs.judgement.score, before + 2.0);
  EXPECT_NEAR(handle_of(pairs.fit.mountains.front()).rotate_deg, turned.rotate_deg, 10.0);
  EXPECT_LT(off_px(pairs.fit, pairs.fit.mountains), 5.0);
}

TEST(FindMountains, StillGroundHasNone) {
  WeighedPairs pairs = painted({}, 5, 2.0);
  move_mountains(pairs, 2.0);
  EXPECT_TRUE(pairs.fit.mountains.empty());
}

TEST(FindMountains, AMountainThatNothingSpeaksForIsDropped) {
  WeighedPairs pairs = painted({}, 5, 2.0);
  pairs.fit.mountains.push_back(
      {turned.centre, pairs.fit.frame.extent_m, {0.0, 0.0, 0.0, 0.4, 0.3, 0.8, 0.0}});
  weigh_by_agreement(pairs, 2.0, 2);
  move_mountains(pairs, 2.0);
  EXPECT_TRUE(pairs.fit.mountains.empty());
}

}  // namespace
}  // namespace belvedere
