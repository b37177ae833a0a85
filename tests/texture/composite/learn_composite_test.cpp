#include "texture/composite/learn_composite.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/texture/composite/composite_crops.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string refusal(const LabelledCrop& crop) {
  try {
    learn_composite(crop, test::quick_learning());
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::input);
    return e.what();
  }
  return "nothing";
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
  for (int y = 100; y < 140; ++y)
    for (int x = 0; x < 60; ++x) {
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
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) narrow.labels(x, y) = x < 50 ? 1 : 0;
  EXPECT_THAT(refusal(narrow.crop()), AllOf(HasSubstr("#808080"), HasSubstr("47 × 120")));

  test::Composite few = test::two_textures(120, 120);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) few.labels(x, y) = std::abs(x - y) < 8 ? 1 : 0;
  EXPECT_THAT(refusal(few.crop()), AllOf(HasSubstr("#808080"), HasSubstr("2304")));

  test::Composite flat = test::two_textures(120, 120);
  for (std::size_t i = 0; i < flat.labels.size(); ++i)
    if (flat.labels[i] == 0) flat.picture[i] = {9, 9, 9};
  EXPECT_THAT(refusal(flat.crop()), AllOf(HasSubstr("#008000"), HasSubstr("single colour")));
}

}  // namespace
}  // namespace belvedere
