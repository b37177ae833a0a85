#include "renderer/paint/ground/ground_tint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "base/random.h"
#include "renderer/image/srgb.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr double level_tone = 0.6;
constexpr double west = 500000.0;
constexpr double top = 5200000.0;

// Level meadow at 1000 m, `size` cells of 10 m on a side, with the given colours.
template <class Colour>
TerrainModel meadow(int size, Colour&& colour, double origin_x = west) {
  TerrainModel model;
  const GeoTransform transform{origin_x, top, 10.0, 10.0};
  model.dem =
      std::make_shared<const Dem>(make_dem({Grid<float>(size, size, 1000.F), transform, ""}));
  model.generalized_m = model.dem->altitude_m;
  LandCover cover{{Grid<LandCoverClass>(size, size, pasture), transform, ""},
                  {Grid<GroundColour>(size, size), transform, ""}};
  for (const auto [x, y] : test::cells(size, size)) cover.colours.cells(x, y) = colour(x, y);
  model.land_cover = std::make_shared<const LandCover>(std::move(cover));
  return model;
}

glm::dvec2 centre_of(int x, int y) { return {west + 10.0 * (x + 0.5), top - 10.0 * (y + 0.5)}; }

TEST(GroundTint, NoColoursNoTint) {
  TerrainModel model = meadow(4, [](int, int) { return GroundColour(1, 2, 3, 255); });
  const Palette palette = read_palette("summer");
  EXPECT_NE(make_ground_tint(model, palette, 1.0), nullptr);
  EXPECT_EQ(make_ground_tint(model, palette, 0.0), nullptr);
  model.land_cover = std::make_shared<const LandCover>(LandCover{model.land_cover->classes});
  EXPECT_EQ(make_ground_tint(model, palette, 1.0), nullptr);
}

TEST(GroundTint, GivesTheColourOfACellAndFromAfarTheMean) {
  // Squares of one cell, 40 and 200: at 10 m per pixel they are distinct, from 20 m on everything
  // is 120.
  const TerrainModel model = meadow(
      64, [](int x, int y) { return GroundColour((x + y) % 2 == 0 ? 40 : 200, 100, 60, 255); });
  const auto tint = make_ground_tint(model, read_palette("summer"), 1.0);
  for (int x = 8; x < 24; ++x) {
    EXPECT_FLOAT_EQ(255.F * ground_colour_at(*tint, centre_of(x, 9), 5.0).r,
                    (x + 9) % 2 == 0 ? 40.F : 200.F);
    for (const double footprint : {20.0, 55.0, 300.0, 1e6}) {
      const glm::vec4 mean = ground_colour_at(*tint, centre_of(x, 9), footprint);
      EXPECT_NEAR(255.F * mean.r, 120.F, 0.01F) << footprint;
      EXPECT_NEAR(255.F * mean.g, 100.F, 0.01F);
      EXPECT_FLOAT_EQ(mean.w, 1.F);
    }
    // Half way between two levels, half way between their colours.
    EXPECT_NEAR(255.F * ground_colour_at(*tint, centre_of(x, 9), 10.0 * std::sqrt(2.0)).r,
                (x + 9) % 2 == 0 ? 80.F : 160.F, 0.01F);
  }
}

TEST(GroundTint, WhatIsUnknownDarkensNothing) {
  const TerrainModel model = meadow(
      32, [](int x, int) { return x < 16 ? GroundColour(150, 90, 30, 255) : GroundColour(0); });
  const auto tint = make_ground_tint(model, read_palette("summer"), 1.0);
  EXPECT_FLOAT_EQ(ground_colour_at(*tint, centre_of(25, 10), 5.0).w, 0.F);
  const glm::vec4 edge = ground_colour_at(*tint, centre_of(15, 10) + glm::dvec2(5.0, 0.0), 5.0);
  EXPECT_FLOAT_EQ(edge.w, 0.5F);
  EXPECT_NEAR(255.F * edge.r, 150.F, 0.01F);
  const glm::vec3 ramp(0.3F, 0.5F, 0.2F);
  const Palette palette = read_palette("summer");
  EXPECT_EQ(
      tint_shift(*tint, palette, pasture, 1000.0, {centre_of(25, 10), 1000.0}, 5.0).over(ramp),
      ramp);
}

TEST(GroundTint, ARampHasTheGroundsColourAtItsMeanLightnessInOpenLight) {
  // Three quarters dark brown, one quarter pale: painted as light as the palette's meadow on
  // average.
  const TerrainModel model = meadow(192, [](int x, int) {
    return x % 4 == 0 ? GroundColour(150, 140, 110, 255) : GroundColour(110, 90, 70, 255);
  });
  const Palette palette = read_palette("summer");
  const auto tint = make_ground_tint(model, palette, 1.0);
  const glm::vec3 open = palette_colour(palette, pasture, 1000.0, level_tone);
  const glm::dvec3 dark = to_oklab(glm::vec3(110, 90, 70) / 255.F);
  const glm::dvec3 pale = to_oklab(glm::vec3(150, 140, 110) / 255.F);
  EXPECT_NEAR(tint->lightness * (0.75 * dark.x + 0.25 * pale.x), to_oklab(open).x, 1e-6);
  double mean = 0.0;
  for (const int x : {4, 5, 6, 7}) {
    const TintShift shift =
        tint_shift(*tint, palette, pasture, 1000.0, {centre_of(x, 50), 1000.0}, 5.0);
    const glm::dvec3 painted = to_oklab(shift.over(open));
    const glm::dvec3 expected = tint->lightness * (x % 4 == 0 ? pale : dark);
    EXPECT_NEAR(painted.x, expected.x, 1e-3) << x;
    EXPECT_NEAR(painted.y, expected.y, 1e-3) << x;
    EXPECT_NEAR(painted.z, expected.z, 1e-3) << x;
    mean += painted.x / 4.0;
    // Light stays the palette's: lighter tones are lighter, shade is darker and bluer.
    const glm::dvec3 shade = to_oklab(shift.over(palette_colour(palette, pasture, 1000.0, 0.1)));
    EXPECT_LT(shade.x, painted.x - 0.1);
    EXPECT_LT(shade.z, painted.z);
  }
  EXPECT_NEAR(mean, to_oklab(open).x, 1e-3);
}

TEST(GroundTint, ShareGoesFromThePaletteToTheGround) {
  const TerrainModel model = meadow(8, [](int, int) { return GroundColour(200, 60, 60, 255); });
  const Palette palette = read_palette("summer");
  const glm::vec3 open = palette_colour(palette, pasture, 1000.0, level_tone);
  const auto painted = [&](double share) {
    return tint_shift(*make_ground_tint(model, palette, share), palette, pasture, 1000.0,
                      {centre_of(3, 3), 1000.0}, 5.0)
        .over(open);
  };
  const glm::vec3 half = painted(0.5);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(half[c], 0.5F * (open[c] + painted(1.0)[c]), 1e-6F);
  EXPECT_GT(painted(1.0).r - painted(1.0).g, 0.2F) << "red ground";
}

// Finer windows of larger terrain have their own colours, which begin at their edge.
TEST(GroundTint, WindowsGoOverFromTheWhole) {
  TerrainModel model = meadow(128, [](int, int) { return GroundColour(100, 100, 100, 255); });
  TerrainModel window = meadow(
      128, [](int, int) { return GroundColour(180, 100, 100, 255); }, west);
  const PixelRect part{0, 0, 128, 128};
  model.windows.push_back({std::move(window), part, {0, 0, 64, 64}});
  const auto tint = make_ground_tint(model, read_palette("summer"), 1.0);
  EXPECT_NEAR(255.F * ground_colour_at(*tint, centre_of(64, 64), 5.0).r, 180.F, 0.01F);
  EXPECT_NEAR(255.F * ground_colour_at(*tint, centre_of(0, 64), 5.0).r, 100.F, 0.01F);
  EXPECT_NEAR(255.F * ground_colour_at(*tint, centre_of(16, 64), 5.0).r, 140.F, 0.01F);
}

using enum LandCoverClass;

TEST(GroundHues, NoiseIsThatOfTheGroundAndFadesWhereItWouldBeSpecks) {
  GroundNoises noises(7);
  const glm::dvec3 position(1234.5, -987.25, 800.0);
  const Patches near = patches_at(noises, position, 0.0F);
  GroundNoises same(7);
  const Patches far = patches_at(same, position, 60.0F);
  EXPECT_EQ(far.n3, 0.5F * near.n3) << "a unit of the sheet covers a patch of 60 m";
  EXPECT_EQ(patches_at(same, position, 90.0F).n3, 0.0F);
  EXPECT_EQ(far.n8, near.n8);
  EXPECT_EQ(patches_at(same, position, 1000.0F).n25, near.n25) << "large patches stay";
  GroundNoises other(8);
  EXPECT_NE(patches_at(other, position, 0.0F).n60, near.n60);
}

TEST(GroundHues, RipeGrassIsYellowAndFreshGrassGreen) {
  const Patches none{0.0F, 0.0F, 0.0F, 0.0F};
  EXPECT_EQ(grass_shift(valley_floor, none, 0.0F), glm::vec3(0.0F));
  EXPECT_EQ(grass_shift(rock, {1.0F, 1.0F, 1.0F, 1.0F}, 12.0F), glm::vec3(0.0F));
  const glm::vec3 fresh = grass_shift(pasture, none, 0.0F);
  EXPECT_NEAR(fresh.r, -0.015F, 1e-6F);
  const glm::vec3 ripe = grass_shift(pasture, {0.0F, 2.0F, 0.0F, 0.0F}, 0.0F);
  EXPECT_NEAR(ripe.r, 0.11F * 0.25F, 1e-6F);
  EXPECT_LT(ripe.b, 0.0F);
  // Ridges are bleached by .16, hollows fresher by .24, in addition to the .15 of all high grass.
  EXPECT_NEAR(grass_shift(alpine_grass, none, 12.0F).r, 0.11F * (-0.15F + 0.16F), 1e-6F);
  EXPECT_NEAR(grass_shift(alpine_grass, none, -12.0F).r, 0.10F * (-0.15F - 0.24F), 1e-6F);
  EXPECT_EQ(grass_shift(valley_floor, none, 12.0F), glm::vec3(0.0F)) << "but not fields";
}

TEST(GroundHues, DriftOnlyOverWhatGrowsAndOverStone) {
  const Palette palette = read_palette("summer");
  const Patches patches{0.3F, 0.5F, 1.0F, -1.0F};
  for (const LandCoverClass still : {water, settlement, snow, glacier})
    EXPECT_EQ(hue_drift(still, patches, palette, 1.0F), glm::vec3(1.0F));
  EXPECT_EQ(hue_drift(rock, patches, palette, 0.0F), glm::vec3(1.0F));
  const float drift = -0.7F + 0.5F;
  EXPECT_NEAR(hue_drift(scree, patches, palette, 1.0F).r, 1.0F + 0.035F * drift, 1e-6F);
  EXPECT_NEAR(hue_drift(rock, patches, palette, 1.0F).r,
              (1.0F + 0.035F * drift) * (1.0F + 0.042F * 0.8F), 1e-6F);
  EXPECT_NEAR(hue_drift(forest, patches, palette, 1.0F).b,
              (1.0F - 0.03F * drift) * (1.0F - 0.05F * 0.95F), 1e-6F);
}

TEST(GroundHues, GreensGoStaleAndRockIsLessWarm) {
  for (const LandCoverClass green : {valley_floor, forest, alpine_grass, pasture, shrub})
    EXPECT_TRUE(has_trait(green, ClassTrait::desaturates));
  for (const LandCoverClass other : {water, settlement, scree, rock, snow, glacier})
    EXPECT_FALSE(has_trait(other, ClassTrait::desaturates));
  EXPECT_EQ(class_info(rock).hue.warmth, 0.6F);
  EXPECT_EQ(class_info(forest).hue.warmth, 1.0F);
}

using enum LandCoverClass;

constexpr Patches even{0.0F, 0.0F, 0.0F, 0.0F};

TEST(MeadowHues, HollowsAreLushAndSunnyRidgesDry) {
  MeadowPosition hollow{.slope_deg = 15.0F,
                        .relief_s_m = -8.0F,
                        .relief_m_m = -35.0F,
                        .valley_height_m = 300.0F,
                        .above_treeline_m = -700.0F};
  MeadowPosition ridge = hollow;
  ridge.sunny = 0.8F;
  ridge.relief_s_m = 8.0F;
  ridge.relief_m_m = 35.0F;
  const MeadowMix wet = meadow_mix(pasture, hollow, even);
  const MeadowMix dry = meadow_mix(pasture, ridge, even);
  EXPECT_GT(wet.lush, 0.9F);
  EXPECT_EQ(wet.dry, 0.0F);
  EXPECT_GT(dry.dry, 0.9F);
  EXPECT_EQ(dry.lush, 0.0F);
  hollow.sunny = -0.5F;
  ridge.sunny = -0.5F;
  EXPECT_LT(meadow_mix(pasture, ridge, even).dry, dry.dry)
      << "what is turned away from the sun dries less";
  // Lush grass is greener than dry grass, not only darker.
  const glm::vec3 a = meadow_hue(wet, 1.0F);
  const glm::vec3 b = meadow_hue(dry, 1.0F);
  EXPECT_GT(a.g / a.r, b.g / b.r + 0.15F);
}

TEST(MeadowHues, TurfIsHighAndMeadowsAreMownLowAndLevel) {
  const MeadowPosition village{
      .slope_deg = 5.0F, .valley_height_m = 30.0F, .above_treeline_m = -1000.0F};
  MeadowPosition alp = village;
  alp.above_treeline_m = 600.0F;
  EXPECT_EQ(meadow_mix(pasture, village, even).mown, 1.0F);
  EXPECT_EQ(meadow_mix(pasture, village, even).high, 0.0F);
  EXPECT_EQ(meadow_mix(pasture, alp, even).mown, 0.0F);
  EXPECT_EQ(meadow_mix(alpine_grass, alp, even).high, 1.0F);
  EXPECT_EQ(meadow_mix(alpine_grass, village, even).mown, 0.0F) << "not mown at that altitude";
  MeadowPosition steep = village;
  steep.slope_deg = 25.0F;
  EXPECT_EQ(meadow_mix(pasture, steep, even).mown, 0.0F);
}

TEST(MeadowHues, OnlyGrassHasThemAndStrengthZeroLeavesColourAlone) {
  const MeadowPosition wet{.relief_s_m = -9.0F, .relief_m_m = -60.0F, .above_treeline_m = 300.0F};
  for (const LandCoverClass id : {forest, rock, snow, water, settlement, scree, glacier, sand}) {
    const MeadowMix mix = meadow_mix(id, wet, even);
    EXPECT_EQ(meadow_hue(mix, 1.0F), glm::vec3(1.0F)) << class_name(id);
    EXPECT_EQ(mix.mown, 0.0F);
  }
  EXPECT_EQ(meadow_hue(meadow_mix(pasture, wet, even), 0.0F), glm::vec3(1.0F));
  EXPECT_NE(meadow_hue(meadow_mix(pasture, wet, even), 1.0F), glm::vec3(1.0F));
  // A valley floor is low everywhere: that alone does not make it a marsh.
  const MeadowPosition floor{.relief_m_m = -60.0F, .above_treeline_m = -1200.0F};
  EXPECT_EQ(meadow_mix(valley_floor, floor, even).lush, 0.0F);
}

// South of the equator the noon sun stands in the north.
TEST(MeadowHues, TheSunnySideIsTheEquators) {
  GuidanceBuffers g;
  g.normal_smooth = Grid<glm::vec3>(1, 1, glm::vec3(0.0F, -0.45F, 0.89F));  // falls to the south
  g.slope_deg = g.relief_s_m = g.relief_m_m = g.valley_height_m = Grid<float>(1, 1, 0.0F);
  g.altitude_m = Grid<float>(1, 1, 1500.0F);
  EXPECT_NEAR(meadow_position(g, 0, 1820.0, 1.0F).sunny, 0.9F, 1e-6F);
  EXPECT_NEAR(meadow_position(g, 0, 1820.0, -1.0F).sunny, -0.9F, 1e-6F);
  EXPECT_NEAR(meadow_position(g, 0, 1820.0, 1.0F).above_treeline_m, -320.0F, 1e-4F);
}

TEST(ForestHues, GulliesAreDarkAndBlueRibsLightAndWarm) {
  const Patches even{0.0F, 0.0F, 0.0F, 0.0F};
  const ForestTurn gully = forest_turn(-8.0F, -40.0F, 0.6F, even, 1.0F);
  const ForestTurn rib = forest_turn(8.0F, 40.0F, 0.6F, even, 1.0F);
  EXPECT_LT(gully.tone, -0.08F);
  EXPECT_GT(rib.tone, 0.08F);
  EXPECT_LT(gully.factor.r, gully.factor.b - 0.08F);
  EXPECT_GT(rib.factor.r, rib.factor.b + 0.07F);
  EXPECT_GT(forest_turn(-8.0F, -40.0F, 0.05F, even, 1.0F).tone, -0.03F) << "shade keeps its forms";
  const ForestTurn level = forest_turn(0.0F, 0.0F, 0.6F, even, 1.0F);
  EXPECT_EQ(level.tone, 0.0F);
  EXPECT_EQ(level.factor, glm::vec3(1.0F));
  EXPECT_EQ(forest_turn(-8.0F, -40.0F, 0.6F, even, 0.0F).factor, glm::vec3(1.0F));
}

}  // namespace
}  // namespace belvedere
