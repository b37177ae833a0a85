#include "renderer/compose/complete_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/compose/massifs.h"
#include "renderer/compose/view_measures.h"
#include "tests/renderer/compose/synthetic_region.h"

namespace belvedere {
namespace {

using test::depression;

GivenView from_the_south() {
  return {.viewer = test::position_km(30.0, 4.0), .azimuth_deg = 0.0, .resolved = {}};
}

void expect_horizon_at_far(const ViewShape& view) {
  EXPECT_GT(depression(view, 0.98 * view.far_m), depression(view, view.far_m));
  EXPECT_GT(depression(view, 1.02 * view.far_m), depression(view, view.far_m));
}

TEST(CompleteView, WithNothingSettledIsTheLayoutOfTheLargestThatFits) {
  const CoarseGround ground = test::chain_region();
  const auto view = complete_view(ground, from_the_south());
  ASSERT_TRUE(view);
  EXPECT_TRUE(fits_data(ground, *view));
  EXPECT_GT(view->far_m, 0.7 * ground.side_m);
  ViewShape shape;
  shape.viewer = view->viewer;
  shape.far_m = view->far_m;
  shape.near_m = view->near_m;
  shape.crest_m = view->crest_m;
  const auto laid = lay_out(ground, shape, find_massifs(ground).lone);
  ASSERT_TRUE(laid);
  EXPECT_EQ(view->radius_m, laid->radius_m);
  EXPECT_EQ(view->eye_m, laid->eye_m);
  EXPECT_EQ(view->pitch_deg, laid->pitch_deg);
  ViewShape larger = *view;
  larger.far_m *= 1.12, larger.near_m *= 1.12;
  EXPECT_FALSE(fits_data(ground, larger));
}

// A given eye has the horizon at the same distance: R = (F² - c²) / 2 (eye - level), and the sky
// its share.
TEST(CompleteView, AGivenEyeSettlesTheBend) {
  const CoarseGround ground = test::chain_region();
  const ViewMeasures found = measure_view(ground, *complete_view(ground, from_the_south()), {});
  for (const double eye_m : {6000.0, 9000.0, 14000.0}) {
    GivenView given = from_the_south();
    given.resolved.eye_m = [=](const ViewShape&) { return eye_m; };
    const auto view = complete_view(ground, given);
    ASSERT_TRUE(view);
    EXPECT_EQ(view->eye_m, eye_m);
    const double over = eye_m - view->base_m - view->level_m;
    EXPECT_NEAR(view->radius_m /
                    ((view->far_m * view->far_m - view->crest_m * view->crest_m) / (2.0 * over)),
                1.0, 1e-12);
    expect_horizon_at_far(*view);
    EXPECT_NEAR(measure_view(ground, *view, {}).skyline.mean, found.skyline.mean, 0.02) << eye_m;
  }
}

TEST(CompleteView, KeepsWhatIsSettled) {
  const CoarseGround ground = test::chain_region();
  GivenView given = from_the_south();
  given.resolved.exaggeration = 1.0;
  given.resolved.base_m = 0.0;
  given.resolved.pitch_deg = [](const ViewShape& view) { return view.eye_m > 0.0 ? -9.0 : 0.0; };
  given.resolved.drop_m = [](double) { return 0.0; };
  const auto view = complete_view(ground, given);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->exaggeration, 1.0);
  EXPECT_EQ(view->base_m, 0.0);
  EXPECT_EQ(view->pitch_deg, -9.0);
  // Level ground, not bent, at the near distance still lies on the lower edge.
  EXPECT_NEAR(
      ComposedPicture(*view).position({0.0, 1.0}, (view->eye_m - view->level_m) / view->near_m).y,
      1.0, 1e-6);
}

TEST(CompleteView, WithoutADirectionLooksWhereSomethingIs) {
  const CoarseGround ground = test::chain_region();
  GivenView given = from_the_south();
  given.azimuth_deg.reset();
  const auto view = complete_view(ground, given);
  ASSERT_TRUE(view);
  EXPECT_LE(std::abs(std::remainder(view->azimuth_deg, 360.0)), 45.0)
      << "the chain lies to the north";
  given.viewer = test::position_km(30.0, 56.0);
  const auto back = complete_view(ground, given);
  ASSERT_TRUE(back);
  EXPECT_LE(std::abs(std::remainder(back->azimuth_deg - 180.0, 360.0)), 45.0);
}

TEST(CompleteView, HasNoneWhereNoDataLie) {
  GivenView given = from_the_south();
  given.azimuth_deg = 180.0;
  given.viewer = test::position_km(30.0, -20.0);
  EXPECT_FALSE(complete_view(test::chain_region(), given));
}

}  // namespace
}  // namespace belvedere
