#include "renderer/compose/view_defaults.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

TEST(ViewDefaults, AreSharesOfTheHorizonsDistance) {
  const HorizonDefaults near = defaults_of_horizon(20000.0);
  EXPECT_NEAR(near.air_from_m, 9000.0, 1e-9);
  EXPECT_NEAR(near.air_scale_m, 18000.0, 1e-9);
  EXPECT_NEAR(near.rim_fade_m, 700.0, 1e-9);
  EXPECT_NEAR(near.foreground_to_m, 8400.0, 1e-9);
  EXPECT_NEAR(near.background_from_m, 19000.0, 1e-9);
  EXPECT_NEAR(defaults_of_horizon(80000.0).background_from_m, 4.0 * near.background_from_m, 1e-6);
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
