#include "renderer/paint/water_look.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/renderer/exemplar/painted_hills.h"
#include "tests/renderer/paint/water/no_noise.h"

namespace belvedere {
namespace {

using test::no_noise;

// One pixel of water far from its shores, below one of forest that it reflects if `mirrors` is set.
struct ForestLake {
  GuidanceBuffers guidance =
      test::make_slope(1, 2, LandCoverClass::forest, {0.0F, 0.0F, 1.0F}, 0.0F);
  Mirrored mirrored{Grid<std::int32_t>(1, 2, -1), Grid<float>(1, 2, 0.0F), Grid<float>(1, 2, 30.0F),
                    Grid<float>(1, 2, 30.0F)};
  Palette palette = read_palette("summer");
  ForestLake() { guidance.land_cover(0, 1) = LandCoverClass::water; }
  WaterLook look(float around, float streak = 0.0F) const {
    return water_look(guidance, palette, mirrored, 1, around, streak, no_noise);
  }
};

TEST(WaterLook, OpenWaterIsItsRamp) {
  const WaterLook look = ForestLake().look(1.0F);
  EXPECT_EQ(look.tone_shift, 0.0F) << "half way between its shores";
  EXPECT_EQ(look.over(glm::vec3(0.2F, 0.3F, 0.4F)), glm::vec3(0.2F, 0.3F, 0.4F));
  EXPECT_NEAR(ForestLake().look(1.0F, 1.0F).tone_shift, 0.09F, 1e-6F) << "streaks are paler";
}

TEST(WaterLook, IsPaleTowardsTheHorizonAndShallowAtTheNearBank) {
  ForestLake lake;
  lake.mirrored.to_near[1] = 60.0F;
  lake.mirrored.to_far[1] = 20.0F;
  EXPECT_NEAR(lake.look(1.0F).tone_shift, 0.26F * 0.25F, 1e-6F);
  lake.mirrored.to_far[1] = 0.7F;
  EXPECT_NEAR(lake.look(1.0F).tone_shift, 0.26F * (60.0F / 60.7F - 0.5F) - 0.30F, 1e-6F)
      << "a dark line under the far bank";
  lake.mirrored.to_near[1] = 1.1F;
  EXPECT_NEAR(lake.look(1.0F).shallow_share, 0.38F, 1e-6F);
}

TEST(WaterLook, MirrorsTheShoreDarkerAndBluer) {
  ForestLake lake;
  lake.mirrored.source[1] = 0;
  lake.mirrored.share[1] = 1.0F;
  const WaterLook look = lake.look(1.0F);
  const glm::vec3 wood = palette_colour(lake.palette, LandCoverClass::forest, 1200.0,
                                        0.75 * static_cast<double>(0.6F));
  EXPECT_NEAR(look.image_share, 0.85F, 1e-6F);
  EXPECT_NEAR(look.image.r, 0.80F * wood.r, 1e-6F);
  EXPECT_NEAR(look.image.b, 0.98F * wood.b, 1e-6F);
  EXPECT_EQ(lake.look(0.1F).image_share, 0.0F) << "a brook shows the sky";
}

TEST(WaterLook, BrooksRunBetweenGrassAndGravel) {
  const ForestLake lake;
  const WaterLook brook = lake.look(0.2F);
  EXPECT_NEAR(brook.bank_share, 0.12F, 1e-6F);
  EXPECT_EQ(brook.bank, palette_colour(lake.palette, LandCoverClass::valley_floor, 1200.0,
                                       static_cast<double>(0.6F)));
  EXPECT_EQ(brook.tone_shift, 0.0F);
  EXPECT_EQ(lake.look(1.0F).bank_share, 0.0F);
}

TEST(WaterLook, GravelLiesOnBanksHereAndThere) {
  EXPECT_EQ(gravel_share(0.08F, {0.0F, 1.0F, 1.0F, 0.0F}), 0.0F) << "not away from water";
  EXPECT_NEAR(gravel_share(0.33F, no_noise), 0.8F * 0.15F, 1e-6F);
  EXPECT_NEAR(gravel_share(0.33F, {0.0F, 1.0F, 1.0F, 0.0F}), 0.8F, 1e-6F);
  EXPECT_EQ(gravel_share(0.33F, {0.0F, -1.0F, 0.0F, 0.0F}), 0.0F);
  EXPECT_NEAR(gravel_colour(1.0).r, 0.93F, 1e-6F);
  EXPECT_NEAR(gravel_colour(0.0).r, 0.55F * 0.93F, 1e-6F);
}

}  // namespace
}  // namespace belvedere
