#include "renderer/paint/water/water_surface.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/renderer/exemplar/painted_hills.h"
#include "tests/renderer/paint/water/no_noise.h"

namespace belvedere {
namespace {

using test::no_noise;

// One pixel of water far from its shores.
struct OpenWater {
  GuidanceBuffers guidance =
      test::make_slope(1, 1, LandCoverClass::water, {0.0F, 0.0F, 1.0F}, 0.0F);
  Mirrored mirrored{Grid<std::int32_t>(1, 1, -1), Grid<float>(1, 1, 0.0F), Grid<float>(1, 1, 30.0F),
                    Grid<float>(1, 1, 30.0F)};
  Palette palette = read_palette("summer");
  WaterParameters parameters;
  WaterGround::Place ground;
  WaterNoises noises{1};

  WaterSources sources() const { return {guidance, palette, parameters}; }
  WaterPixel pixel() const {
    return {.index = 0,
            .position_m = {700.0, 900.0, 1200.0},
            .metres_per_unit = 5.0F,
            .ground = ground,
            .mirrored = mirrored,
            .share = 1.0F,
            .streak = 0.0F,
            .patches = no_noise};
  }
  WaterSurface surface() { return water_surface(sources(), noises, pixel()); }
};

TEST(WaterSurface, WithoutABedIsItsLook) {
  OpenWater lake;
  const WaterSurface surface = lake.surface();
  EXPECT_EQ(surface.bed.depth_m, 0.0F);
  EXPECT_EQ(surface.frozen, 0.0F);
  EXPECT_EQ(
      surface.look.tone_shift,
      water_look(lake.guidance, lake.palette, lake.mirrored, 0, 1.0F, 0.0F, no_noise).tone_shift);
}

TEST(WaterSurface, LakesAreDarkByTheirDepthWhateverLightFallsOnThem) {
  OpenWater lake;
  lake.guidance.tone[0] = 0.9F;
  lake.ground = {40.0F, 1.0F};
  EXPECT_NEAR(lake.surface().look.tone_shift, -0.85F * (0.9F - 0.20F), 1e-6F);
  lake.ground.lake = 0.0F;
  EXPECT_NEAR(lake.surface().look.tone_shift, 0.0F, 1e-6F) << "a river keeps its light";
  lake.ground = {40.0F, 1.0F};
  lake.parameters.beds = false;
  EXPECT_NEAR(lake.surface().look.tone_shift, 0.0F, 1e-6F);
}

TEST(WaterSurface, ABedTakesThePlaceOfTheLineAlongBanks) {
  OpenWater lake;
  lake.mirrored.to_near[0] = 1.1F;
  EXPECT_GT(lake.surface().look.shallow_share, 0.3F);
  lake.ground = {40.0F, 1.0F};
  EXPECT_EQ(lake.surface().look.shallow_share, 0.0F);
}

TEST(WaterSurface, LakesHaveATurquoiseRimADarkMiddleAndStreaksTowardsTheFarShore) {
  OpenWater lake;
  lake.ground = {0.5F, 1.0F};
  const WaterLook rim = lake.surface().look;
  EXPECT_GT(rim.shallow_share, 0.5F);
  EXPECT_GT(rim.shallow.g, 1.3F * rim.shallow.r);
  EXPECT_EQ(rim.white_share, 0.0F);
  lake.ground = {40.0F, 1.0F};
  const auto middle = [&](float to_far, float streak) {
    lake.mirrored.to_far[0] = to_far;
    WaterPixel pixel = lake.pixel();
    pixel.streak = streak;
    return water_surface(lake.sources(), lake.noises, pixel).look;
  };
  EXPECT_LT(middle(60.0F, 0.0F).depth.r, 0.82F);
  EXPECT_GT(middle(60.0F, 0.0F).depth.b, middle(60.0F, 0.0F).depth.r);
  EXPECT_GT(middle(5.0F, 2.0F).white_share, 0.15F);
  EXPECT_EQ(middle(60.0F, 2.0F).white_share, 0.0F) << "none below the viewer";
  EXPECT_EQ(middle(5.0F, 0.0F).white_share, 0.0F);
}

TEST(WaterSurface, NothingIsMirroredWhereNothingShallBe) {
  OpenWater lake;
  lake.mirrored.source[0] = 0;
  lake.mirrored.share[0] = 1.0F;
  EXPECT_GT(lake.surface().look.image_share, 0.5F);
  lake.parameters.mirror = "none";
  EXPECT_EQ(lake.surface().look.image_share, 0.0F);
}

TEST(WaterSurface, FrozenLakesLieUnderIceAndRiversRunOpen) {
  OpenWater lake;
  lake.palette = read_palette("winter");
  lake.palette.lakes_freeze_from_m = -std::numeric_limits<double>::infinity();
  lake.ground = {20.0F, 1.0F};
  const glm::vec3 water(0.1F, 0.2F, 0.3F);
  const auto over = [&] {
    return frozen_over(water, lake.sources(), lake.noises, lake.pixel(), lake.surface(), 0.6);
  };
  EXPECT_EQ(over(), lake.noises.ice.colour(lake.palette, lake.guidance.altitude_m[0], 0.6,
                                           lake.pixel().position_m, 20.0F, 5.0F));
  lake.ground.lake = 0.0F;
  EXPECT_EQ(over(), water);
  lake.ground.lake = 1.0F;
  lake.palette.lakes_freeze_from_m = 5000.0;
  EXPECT_EQ(over(), water);
}

}  // namespace
}  // namespace belvedere
