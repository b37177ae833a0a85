#include "renderer/paint/water/lake_ice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace belvedere {
namespace {

TEST(LakeIce, IsPaleBlueGreyUnderDriftsOfSnow) {
  const Palette palette = read_palette("winter");
  LakeIce ice(1);
  const glm::vec3 snow = palette_colour(palette, LandCoverClass::snow, 900.0, 0.6);
  float darkest = 1.0F;
  float lightest = 0.0F;
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) {
      const glm::vec3 colour =
          ice.colour(palette, 900.0, 0.6, {60.0 * x, 60.0 * y, 900.0}, 30.0F, 10.0F);
      EXPECT_GE(colour.b, colour.r - 0.12F);
      for (int c = 0; c < 3; ++c)
        ASSERT_LE(colour[c], snow[c] + 1e-5F) << "no ice is whiter than snow";
      darkest = std::min(darkest, colour.r);
      lightest = std::max(lightest, colour.r);
    }
  EXPECT_GT(lightest, 0.95F * snow.r);
  EXPECT_LT(darkest, 0.88F * snow.r);
  EXPECT_GT(darkest, 0.45F * snow.r);
}

TEST(LakeIce, IsWetAlongTheShore) {
  const Palette palette = read_palette("winter");
  LakeIce ice(1);
  const auto at = [&](float depth_m) {
    return ice.colour(palette, 900.0, 0.6, {500.0, 500.0, 900.0}, depth_m, 10.0F).r;
  };
  EXPECT_LT(at(0.0F), 0.9F * at(20.0F));
  EXPECT_EQ(at(10.0F), at(20.0F));
}

TEST(LakeIce, LakesFreezeInWinterAboveTheirAltitude) {
  Palette palette = read_palette("winter");
  EXPECT_FALSE(is_frozen(palette, 3000.0)) << "a palette alone has no climate";
  palette.lakes_freeze_from_m = 900.0;
  EXPECT_TRUE(is_frozen(palette, 900.0));
  EXPECT_FALSE(is_frozen(palette, 899.0));
  Palette summer = read_palette("summer");
  summer.lakes_freeze_from_m = -std::numeric_limits<double>::infinity();
  EXPECT_FALSE(is_frozen(summer, 3000.0));
}

}  // namespace
}  // namespace belvedere
