#include "renderer/paint/water/river_water.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

constexpr Patches deep{.n3 = 0.F, .n8 = 0.F, .n25 = 0.F, .n60 = 2.F};
constexpr Patches shallow{.n3 = 0.F, .n8 = 0.F, .n25 = 1.F, .n60 = -2.F};
constexpr glm::vec3 blue{0.4F, 0.6F, 0.8F};

TEST(RiverWater, PoolsAreDarkTealInTheMiddleOnly) {
  const WaterLook pool = with_current({}, 1.F, 0.F, deep, 1.F);
  EXPECT_LT(pool.tone_shift, -0.1F);
  const glm::vec3 colour = pool.over(blue);
  EXPECT_LT(colour.r / blue.r, colour.g / blue.g);
  const WaterLook bank = with_current({}, 0.4F, 0.F, deep, 1.F);
  EXPECT_EQ(bank.tone_shift, 0.F);
  EXPECT_EQ(bank.over(blue), blue);
}

TEST(RiverWater, RifflesBreakInLightDashes) {
  const WaterLook dash = with_current({}, 1.F, 2.F, shallow, 1.F);
  const WaterLook between = with_current({}, 1.F, -1.F, shallow, 1.F);
  EXPECT_GT(dash.over(blue).r, between.over(blue).r + 0.2F);
  EXPECT_EQ(between.over(blue), blue);
  EXPECT_GT(between.tone_shift, 0.F);
}

TEST(RiverWater, LakesStayAsTheyAre) {
  for (const Patches& patches : {deep, shallow}) {
    const WaterLook lake = with_current({}, 1.F, 2.F, patches, 0.F);
    EXPECT_EQ(lake.tone_shift, 0.F);
    EXPECT_EQ(lake.over(blue), blue);
  }
}

}  // namespace
}  // namespace belvedere
