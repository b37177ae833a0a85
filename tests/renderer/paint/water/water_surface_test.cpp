#include "renderer/paint/water/water_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>

#include "base/colour/water_colour.h"
#include "tests/grids.h"
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

constexpr double lake_west = 500000.0;
constexpr double lake_top = 5200000.0;

// A level lake at 900 m on cells of 10 m whose bed falls one metre per cell to the east, its layers
// of one colour.
TerrainModel lake(int size, GroundColour colour = GroundColour(170, 150, 110, 255)) {
  TerrainModel model;
  const GeoTransform transform{lake_west, lake_top, 10.0, 10.0};
  model.dem =
      std::make_shared<const Dem>(make_dem({Grid<float>(size, size, 900.F), transform, ""}));
  model.generalized_m = model.dem->altitude_m;
  LandCover cover{{Grid<LandCoverClass>(size, size, LandCoverClass::water), transform, ""},
                  {Grid<GroundColour>(size, size, colour), transform, ""},
                  {transform, {}, Grid<float>(size, size)}};
  for (const auto [x, y] : test::cells(size, size))
    cover.relief.lake_depth_m(x, y) = static_cast<float>(x);
  model.land_cover = std::make_shared<const LandCover>(std::move(cover));
  return model;
}

glm::dvec3 position_of(int x) { return {lake_west + 10.0 * (x + 0.5), lake_top - 205.0, 900.0}; }

TEST(LakeBed, IsSeenThroughShallowWaterAndNotThroughDeep) {
  const TerrainModel model = lake(60);
  const Palette palette = read_palette("summer");
  const auto tint = make_ground_tint(model, palette, 1.0);
  const glm::vec3 water(0.2F, 0.4F, 0.55F);
  const auto seen = [&](int x) {
    const LakeBed bed = lake_bed(*tint, palette, 900.0, position_of(x), 5.0);
    EXPECT_FLOAT_EQ(bed.depth_m, static_cast<float>(x));
    return bed.under(water, palette, 900.0, 0.6);
  };
  EXPECT_EQ(seen(0), water) << "no lake";
  // By the formula of water: the bed in the layers' colour, painted as debris, under this depth of
  // water.
  const glm::vec3 ground =
      tint_shift(*tint, palette, LandCoverClass::scree, 900.0, position_of(1), 5.0)
          .over(palette_colour(palette, LandCoverClass::scree, 900.0, 0.6));
  const glm::vec3 shallow = shallow_water(water);
  EXPECT_GT(shallow.g - water.g, 0.1F) << "paler and greener";
  EXPECT_GT(shallow.g - water.g, shallow.b - water.b + 0.05F);
  for (const int x : {1, 3, 8})
    EXPECT_LT(glm::distance(seen(x), water_colour(ground, static_cast<float>(x), {shallow, water})),
              1e-6F)
        << x;
  EXPECT_GT(seen(1).r, seen(4).r);
  EXPECT_GT(seen(4).g, seen(20).g);
  EXPECT_LT(glm::distance(seen(59), water), 0.003F) << "deep water is the palette's";
}

TEST(LakeBed, GoesOnlyAsFarAsTheColoursOfLayers) {
  const TerrainModel model = lake(30);
  const Palette palette = read_palette("summer");
  const glm::vec3 water(0.2F, 0.4F, 0.55F);
  const auto under = [&](double share) {
    return lake_bed(*make_ground_tint(model, palette, share), palette, 900.0, position_of(2), 5.0)
        .under(water, palette, 900.0, 0.6);
  };
  EXPECT_GT(glm::distance(under(1.0), water), glm::distance(under(0.5), water));
  EXPECT_EQ(lake_bed(*make_ground_tint(model, palette, 1.0), read_palette("winter"), 900.0,
                     position_of(2), 5.0)
                .depth_m,
            0.F);
  // Unknown ground has no visible bed.
  const TerrainModel unknown = lake(30, GroundColour(0));
  EXPECT_EQ(lake_bed(*make_ground_tint(unknown, palette, 1.0), palette, 900.0, position_of(2), 5.0)
                .under(water, palette, 900.0, 0.6),
            water);
}

// Inside a window its own depths apply.
TEST(LakeBed, WindowsHaveDepthsOfTheirOwn) {
  TerrainModel model = lake(64);
  TerrainModel window = lake(64);
  LandCover deeper = *window.land_cover;
  for (float& depth : deeper.relief.lake_depth_m) depth = 40.F;
  window.land_cover = std::make_shared<const LandCover>(std::move(deeper));
  model.windows.push_back({std::move(window), {10, 0, 64, 64}, {5, 0, 32, 32}});
  const auto tint = make_ground_tint(model, read_palette("summer"), 1.0);
  EXPECT_FLOAT_EQ(lake_depth_at(*tint, glm::dvec2(position_of(30))), 40.F);
  EXPECT_FLOAT_EQ(lake_depth_at(*tint, glm::dvec2(position_of(5))), 5.F);
}

TEST(LakeIce, IsPaleBlueGreyUnderDriftsOfSnow) {
  const Palette palette = read_palette("winter");
  LakeIce ice(1);
  const glm::vec3 snow = palette_colour(palette, LandCoverClass::snow, 900.0, 0.6);
  float darkest = 1.0F;
  float lightest = 0.0F;
  for (const auto [x, y] : test::cells(100, 100)) {
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

// Share of ruffled water over 40 × 40 km.
double ruffled_share(std::uint64_t seed, float strength) {
  WaterWind wind(seed);
  double sum = 0.0;
  for (const auto [x, y] : test::cells(200, 200))
    sum += static_cast<double>(wind.ruffled({200.0 * x, 200.0 * y, 900.0}, 10.0F, strength));
  return sum / 40000.0;
}

TEST(WaterWind, RufflesPatchesOfALake) {
  EXPECT_EQ(ruffled_share(1, 0.0F), 0.0);
  EXPECT_NEAR(ruffled_share(1, 1.0F), 0.2, 0.05);
  EXPECT_GT(ruffled_share(1, 2.0F), ruffled_share(1, 1.0F) + 0.05);
}

TEST(WaterWind, HangsOnThePlaceAlone) {
  WaterWind a(5);
  WaterWind b(5);
  for (int k = 0; k < 50; ++k) b.ruffled({31.0 * k, 7.0 * k, 0.0}, 3.0F, 1.0F);
  EXPECT_EQ(a.ruffled({1234.5, -77.0, 900.0}, 8.0F, 1.0F),
            b.ruffled({1234.5, -77.0, 100.0}, 8.0F, 1.0F));
}

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
