#include "renderer/compose/view_layout.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/math.h"
#include "renderer/compose/view_measures.h"
#include "tests/renderer/compose/synthetic_region.h"

namespace belvedere {
namespace {

using test::depression;

// From the south of the region northwards.
ViewShape northward(double aspect = 2.0, bool cylinder = false, double field_deg = 44.0) {
  ViewShape view;
  view.viewer = test::position_km(30.0, -8.0);
  view.field_of_view_deg = field_deg;
  view.aspect = aspect;
  view.cylinder = cylinder;
  view.far_m = 52000.0;
  view.near_m = 0.42 * view.far_m;
  view.crest_m = 0.8 * view.far_m;
  return view;
}

struct Format {
  const char* name;
  double aspect;
  bool cylinder;
  double field_deg;
};
class Layout : public testing::TestWithParam<Format> {
 protected:
  ViewShape shape() const {
    return northward(GetParam().aspect, GetParam().cylinder, GetParam().field_deg);
  }
};

TEST_P(Layout, LevelGroundAtNearLiesOnTheLowerEdge) {
  const std::optional<ViewShape> view = lay_out(test::chain_region(), shape(), 0.0);
  ASSERT_TRUE(view);
  EXPECT_NEAR(ComposedPicture(*view).position({0.0, 1.0}, depression(*view, view->near_m)).y, 1.0,
              1e-6);
}

TEST_P(Layout, BentLevelGroundTouchesTheLineOfSightAtTheHorizon) {
  const std::optional<ViewShape> view = lay_out(test::chain_region(), shape(), 0.0);
  ASSERT_TRUE(view);
  const double at_far = depression(*view, view->far_m);
  EXPECT_GT(depression(*view, 0.99 * view->far_m), at_far);
  EXPECT_GT(depression(*view, 1.01 * view->far_m), at_far);
  EXPECT_NEAR((depression(*view, view->far_m + 1.0) - depression(*view, view->far_m - 1.0)) / 2.0,
              0.0, 1e-9)
      << "tangent";
}

TEST_P(Layout, TheSkyHasItsShare) {
  const CoarseGround ground = test::chain_region();
  const LayoutParameters parameters;
  const std::optional<ViewShape> view = lay_out(ground, shape(), 0.0, parameters);
  ASSERT_TRUE(view);
  const ViewMeasures m = measure_view(ground, *view, {});
  // Either most of the skyline or the highest summit is where it should be, by the samples of
  // another fan.
  const double over_summit = m.skyline.summit - parameters.over_summit;
  EXPECT_GT(over_summit, -0.012);
  EXPECT_GT(m.skyline.median, parameters.sky - 0.012);
  EXPECT_LT(std::min(over_summit, m.skyline.median - 0.02 - parameters.sky), 0.012);
}

INSTANTIATE_TEST_SUITE_P(Formats, Layout,
                         testing::Values(Format{"square", 1.0, false, 34.0},
                                         Format{"usual", 2.0, false, 44.0},
                                         Format{"wide", 3.0, false, 52.0},
                                         Format{"strip", 5.0, true, 65.0}),
                         [](const auto& p) { return p.param.name; });

TEST(Layout, WedgesOutsideOfTheDataDoNotFit) {
  const CoarseGround ground = test::chain_region();
  EXPECT_TRUE(fits_data(ground, northward()));
  ViewShape off = northward();
  off.viewer = test::position_km(5.0, -8.0);
  EXPECT_FALSE(fits_data(ground, off)) << "the left of it lies west of the data";
  ViewShape beyond = northward();
  beyond.far_m = 90000.0;
  beyond.near_m = 0.42 * beyond.far_m;
  EXPECT_FALSE(fits_data(ground, beyond));
  EXPECT_FALSE(lay_out(
      ground,
      [] {
        ViewShape nowhere = northward();
        nowhere.viewer = test::position_km(500.0, 0.0);
        return nowhere;
      }(),
      0.0));
}

TEST(Layout, FlatterLandIsExaggeratedMore) {
  const auto region = [](double height) {
    return make_coarse_ground(
        test::synthetic_raster(
            60.0, [&](double e, double n) { return 600.0 + height * (test::chain(e, n) - 600.0); }),
        300.0);
  };
  const auto steep = lay_out(region(1.0), northward(), 0.0);
  const auto flat = lay_out(region(0.3), northward(), 0.0);
  ASSERT_TRUE(steep && flat);
  EXPECT_GT(flat->exaggeration, steep->exaggeration);
  EXPECT_LE(flat->exaggeration, 2.0);
  EXPECT_GE(steep->exaggeration, 1.2);
}

}  // namespace
}  // namespace belvedere
