#include "texture/composite/learn_composite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/random.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/texture/composite/composite_crops.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string refusal(const LabelledCrop& crop) {
  return test::input_error([&] { learn_composite(crop, test::quick_learning()); });
}

TEST(LearnComposite, EachLabelIsLearntFromItsOwnPixels) {
  const test::Composite two = test::two_textures(220, 160);
  const CompositeModel model = learn_composite(two.crop(), test::quick_learning());
  ASSERT_EQ(model.labels.size(), 2U);
  EXPECT_EQ(model.labels[0].name, "#008000");
  // The meadow is green, the stripes are grey: neither contains colours of the other.
  const auto& green = model.labels[0].model.bands.mean;
  const auto& grey = model.labels[1].model.bands.mean;
  EXPECT_GT(green[1], green[2] + 40.F);
  EXPECT_LT(std::abs(grey[1] - grey[2]), 8.F);
  ASSERT_TRUE(model.transition);
  EXPECT_GT(model.transition->bands.mean[1], std::min(green[1], grey[1]) - 1.F);
  EXPECT_LT(model.transition->bands.mean[1], std::max(green[1], grey[1]) + 1.F);
  EXPECT_EQ(model.map.labels, 2);
  EXPECT_EQ(model.map.profile[0], 1.F);
}

TEST(LearnComposite, UnknownPixelsBelongToNothing) {
  test::Composite two = test::two_textures(140, 140);
  for (const auto [x, y] : test::cells({0, 100, 60, 140})) {
    two.picture(x, y) = {255, 0, 0};
    two.labels(x, y) = no_label;
  }
  const CompositeModel model = learn_composite(two.crop(), test::quick_learning());
  EXPECT_LT(std::abs(model.labels[1].model.bands.mean[0] - model.labels[1].model.bands.mean[2]),
            8.F);
  EXPECT_EQ(model.map.labels, 2);
}

TEST(LearnComposite, ShortBordersHaveNoTransition) {
  const test::Composite two = test::two_textures(70, 130);
  EXPECT_FALSE(learn_composite(two.crop(), test::quick_learning()).transition);
}

// A square of 20 pixels in the stripes joins them, a flat strip below joins what it touches, and
// what is unknown stays so; numbers follow their order.
TEST(LearnComposite, SmallLabelsAreJoinedToTheirNeighbours) {
  test::Composite two = test::two_textures(120, 150);
  const Grid<std::uint8_t> truth = two.labels;
  for (std::uint8_t& label : two.labels) label = label == 0 ? 9 : 4;
  for (const auto [x, y] : test::cells({50, 100, 70, 120})) two.labels(x, y) = 2;
  for (const auto [x, y] : test::cells({0, 145, 120, 150})) {
    two.labels(x, y) = 200;
    two.picture(x, y) = {1, 2, 3};
  }
  for (const auto [x, y] : test::cells({0, 0, 10, 10})) two.labels(x, y) = no_label;
  const Grid<std::uint8_t> joined = join_small_labels(two.crop());
  for (const auto [x, y] : test::cells(120, 150)) {
    if (x < 10 && y < 10)
      ASSERT_EQ(joined(x, y), no_label);
    else
      ASSERT_EQ(joined(x, y), 1 - truth(x, y)) << x << ", " << y;
  }
  // All of them are small: one is left.
  test::Composite tiny = test::two_textures(60, 60);
  for (const auto [x, y] : test::cells(60, 60))
    tiny.labels(x, y) = static_cast<std::uint8_t>(x / 10);
  EXPECT_EQ(join_small_labels(tiny.crop()), Grid<std::uint8_t>(60, 60));
}

TEST(LearnComposite, BadLabelsAreNamed) {
  test::Composite two = test::two_textures(120, 120);
  two.names = {"3"};
  two.labels = Grid<std::uint8_t>(120, 120);
  EXPECT_THAT(refusal(two.crop()), AllOf(HasSubstr("1 label\n"), HasSubstr("2 to 16")));
  two.names.resize(17, "x");
  EXPECT_THAT(refusal(two.crop()), HasSubstr("17 labels"));

  test::Composite other = test::two_textures(120, 120);
  other.labels = Grid<std::uint8_t>(120, 119);
  EXPECT_THAT(refusal(other.crop()), AllOf(HasSubstr("120 × 119"), HasSubstr("120 × 120")));

  test::Composite narrow = test::two_textures(120, 120);
  for (const auto [x, y] : test::cells(120, 120)) narrow.labels(x, y) = x < 50 ? 1 : 0;
  EXPECT_THAT(refusal(narrow.crop()), AllOf(HasSubstr("#808080"), HasSubstr("47 × 120")));

  test::Composite few = test::two_textures(120, 120);
  for (const auto [x, y] : test::cells(120, 120)) few.labels(x, y) = std::abs(x - y) < 8 ? 1 : 0;
  EXPECT_THAT(refusal(few.crop()), AllOf(HasSubstr("#808080"), HasSubstr("2304")));

  test::Composite flat = test::two_textures(120, 120);
  for (std::size_t i = 0; i < flat.labels.size(); ++i)
    if (flat.labels[i] == 0) flat.picture[i] = {9, 9, 9};
  EXPECT_THAT(refusal(flat.crop()), AllOf(HasSubstr("#008000"), HasSubstr("single colour")));
}

// Light above a height, dark below.
Grid<Rgb8> halves(int width, int height, bool turned) {
  Grid<Rgb8> out(width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    const auto grain = static_cast<std::uint8_t>(random_index(8, 1, x, y));
    const auto v = static_cast<std::uint8_t>(((y < height / 2) != turned ? 200 : 40) + grain);
    out(x, y) = {v, v, static_cast<std::uint8_t>(v / 2)};
  }
  return out;
}

TEST(LayoutFigures, KnowTopFromBottomAtAnySize) {
  const Grid<Rgb8> crop = halves(160, 160, false);
  const LayoutFigures same = layout_figures(crop, crop);
  EXPECT_EQ(same.profile, 0.0);
  EXPECT_EQ(same.far_pairs, 0.0);
  EXPECT_LT(layout_figures(crop, halves(200, 320, false)).profile, .02);
  // Turned over, every strip contains what it never contained; differences along rows stay, those
  // along columns change their sign.
  const LayoutFigures turned = layout_figures(crop, halves(160, 160, true));
  EXPECT_NEAR(turned.profile, 2.0, 1e-9);
  // In one band of three, along columns: of pairs d apart the share d / (160 - d), at most 1,
  // crosses the centre, and all of these change.
  EXPECT_NEAR(turned.far_pairs, 2.0 / 24.0 * (16.0 / 144.0 + 32.0 / 128.0 + 64.0 / 96.0 + 1.0),
              .01);
}

// The brightest colour is in no strip's share of another one's.
TEST(LayoutFigures, OfOtherColoursHaveNothingInCommon) {
  Grid<Rgb8> white(160, 160);
  Grid<Rgb8> blue(160, 160);
  for (const auto [x, y] : test::cells(160, 160)) {
    const auto grain = static_cast<std::uint8_t>(random_index(8, 1, x, y));
    white(x, y).fill(static_cast<std::uint8_t>(248 + grain));
    blue(x, y) = {grain, grain, static_cast<std::uint8_t>(192 + grain)};
  }
  EXPECT_NEAR(layout_figures(white, blue).profile, 2.0, 1e-9);
}

}  // namespace
}  // namespace belvedere
