#include "texture/statistical/texture_figures.h"

#include <gtest/gtest.h>

#include "tests/texture/statistical/texture_crops.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {
namespace {

const LearnParameters quick_learning{.types = 24, .levels = 2, .reach_px = 6, .coarse_reach = 3};

TEST(TextureFigures, ACropIsItsOwnTexture) {
  const Grid<Rgb8> crop = test::meadow_crop(96, 96);
  const CliqueModel model = learn_texture(crop, {}, quick_learning).model;
  const TextureFigures own = texture_figures(crop, {}, crop, model, quick_learning);
  EXPECT_EQ(own.selected, 0.0);
  EXPECT_EQ(own.held_out, 0.0);
  EXPECT_EQ(own.beyond, 0.0);
  EXPECT_EQ(own.drawn, 0.0);
  EXPECT_EQ(own.turned, 0.0);
}

// Horizontal stripes are as coherent as vertical ones, but have another direction.
TEST(TextureFigures, PaintThatRunsAnotherWayIsToldWhereItIsDrawnAlike) {
  const Grid<Rgb8> crop = test::striped_crop(96, 96, 8);
  Grid<Rgb8> laid(96, 96);
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) laid(x, y) = crop(y, x);
  const CliqueModel model = learn_texture(crop, {}, quick_learning).model;
  const TextureFigures of = texture_figures(crop, {}, laid, model, quick_learning);
  EXPECT_LT(of.drawn, .1);
  EXPECT_GT(of.turned, 1.5);
}

// Stripes have one direction everywhere, a meadow's dabs hardly any.
TEST(TextureFigures, PaintThatRunsOneWayIsToldFromDabs) {
  const Grid<Rgb8> crop = test::meadow_crop(96, 96);
  const CliqueModel model = learn_texture(crop, {}, quick_learning).model;
  const double stripes =
      texture_figures(crop, {}, test::striped_crop(96, 96, 8), model, quick_learning).drawn;
  const double other_meadow =
      texture_figures(crop, {}, test::meadow_crop(96, 96, 31), model, quick_learning).drawn;
  EXPECT_GT(stripes, 1.0);
  EXPECT_LT(other_meadow, .5 * stripes);
}

// The result is as close as two halves of the crop to each other, and far closer than noise: also
// for types that the model lacks.
TEST(TextureFigures, WhatIsMadeIsAsNearAsTheCropsHalves) {
  const Grid<Rgb8> crop = test::meadow_crop(128, 128);
  const CliqueModel model = learn_texture(crop, {}, quick_learning).model;
  const TextureFigures made =
      texture_figures(crop, {}, make_texture(model, 128, 128, {}), model, quick_learning);
  const TextureFigures halves = halves_figures(crop, model, quick_learning);
  const TextureFigures other =
      texture_figures(crop, {}, test::striped_crop(128, 128, 8), model, quick_learning);
  EXPECT_LT(made.selected, halves.selected);
  EXPECT_LT(made.held_out, 1.2 * halves.held_out);
  EXPECT_LT(made.held_out, .25 * other.held_out);
  EXPECT_LT(halves.held_out, uneven_halves);
}

TEST(TextureFigures, ACropOfTwoThingsIsToldByItsHalves) {
  Grid<Rgb8> crop = test::meadow_crop(128, 128);
  for (int y = 0; y < 128; ++y)
    for (int x = 64; x < 128; ++x) crop(x, y) = {static_cast<std::uint8_t>(200 + x % 3), 200, 220};
  const CliqueModel model = learn_texture(crop, {}, quick_learning).model;
  EXPECT_GT(halves_figures(crop, model, quick_learning).held_out, uneven_halves);
}

TEST(LongestCopy, IsTheSideOfTheLargestSquareInBoth) {
  const Grid<Rgb8> crop = test::meadow_crop(64, 64, 7);
  Grid<Rgb8> made = test::meadow_crop(64, 64, 99);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 5; ++x) made(30 + x, 20 + y) = crop(9 + x, 40 + y);
  EXPECT_EQ(longest_copy_px(crop, made), 5);
  EXPECT_EQ(longest_copy_px(crop, crop), 16);
}

// No verbatim copies: a model contains no patches to copy.
TEST(LongestCopy, IsShortInWhatIsMade) {
  const Grid<Rgb8> crop = test::meadow_crop(96, 96);
  EXPECT_LE(longest_copy_px(
                crop, make_texture(learn_texture(crop, {}, quick_learning).model, 128, 128, {})),
            3);
}

}  // namespace
}  // namespace belvedere
