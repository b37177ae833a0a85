#include "renderer/paint/ground/ground_tint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "renderer/image/oklab.h"

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
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) cover.colours.cells(x, y) = colour(x, y);
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

}  // namespace
}  // namespace belvedere
