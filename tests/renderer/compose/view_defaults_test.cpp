#include "renderer/compose/view_defaults.h"

#include <gtest/gtest.h>

#include "renderer/paint/air.h"

namespace belvedere {
namespace {

TEST(ViewDefaults, AreSharesOfTheHorizonsDistance) {
  const HorizonDefaults near = defaults_of_horizon(20000.0);
  EXPECT_NEAR(near.air_from_m, 9000.0, 1e-9);
  EXPECT_NEAR(near.air_scale_m, 12000.0, 1e-9);
  EXPECT_NEAR(near.rim_fade_m, 700.0, 1e-9);
  EXPECT_NEAR(near.foreground_to_m, 8400.0, 1e-9);
  EXPECT_NEAR(near.background_from_m, 19000.0, 1e-9);
  EXPECT_NEAR(defaults_of_horizon(80000.0).background_from_m, 4.0 * near.background_from_m, 1e-6);
}

// Warm and clear in front, cool behind: at .9 of the horizon's distance instead of .6 the last
// range had only a quarter of the haze, and regions with their own view were the same green from
// front to back.
TEST(ViewDefaults, TheLastRangeStandsInTheAirAndTheForegroundDoesNot) {
  for (const double far_m : {12000.0, 90000.0}) {
    const HorizonDefaults view = defaults_of_horizon(far_m);
    AirParameters air;
    air.haze = view_haze, air.from_m = view.air_from_m, air.scale_m = view.air_scale_m;
    const auto share = [&](double part, double above_m) {
      return haze_share(air, part * far_m, air.floor_m + above_m);
    };
    EXPECT_EQ(share(0.42, 0.0), 0.0);
    EXPECT_GT(foreground_warmth(air, 0.42 * far_m), 0.85F);
    EXPECT_LT(share(0.70, 0.0), 0.25) << "the middle stays clear";
    EXPECT_GT(share(1.0, 0.0), 0.42);
    EXPECT_LT(share(1.0, 0.0), 0.55) << "and readable";
    EXPECT_GT(share(1.0, 1500.0), 0.28) << "summits too";
  }
}

TEST(ViewDefaults, ThePaintersSunStandsToTheLeft) {
  EXPECT_EQ(painter_sun(180.0).azimuth_deg, 68.0) << "looking south, from the east";
  EXPECT_EQ(painter_sun(0.0).azimuth_deg, 248.0);
  EXPECT_EQ(painter_sun(-150.0).azimuth_deg, 98.0);
  EXPECT_EQ(painter_sun(10.0).altitude_deg, 31.0);
}

TEST(ViewDefaults, ValuesAreWrittenInFourFigures) {
  EXPECT_EQ(rounded_m(123456.0), 123500.0);
  EXPECT_EQ(rounded_m(9999.4), 9999.0);
  EXPECT_EQ(rounded_m(10001.0), 10000.0);
  EXPECT_EQ(rounded_m(0.4), 0.0);
  EXPECT_EQ(rounded_to(1.4349, 100.0), 1.43);
  EXPECT_EQ(turned_deg(-30.0), 330.0);
}

}  // namespace
}  // namespace belvedere
