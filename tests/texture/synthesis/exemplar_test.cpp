#include "texture/synthesis/exemplar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "base/error.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Exemplar exemplar_of(int width, int height) {
  Exemplar exemplar;
  exemplar.name = "alps";
  exemplar.picture = Grid<Rgb8>(width, height);
  exemplar.guides.label = Grid<std::uint8_t>(width, height, 3);
  return exemplar;
}

std::string refused_exemplar(const Exemplar& exemplar, ErrorKind kind = ErrorKind::usage) {
  return test::message_of(kind, [&] { check_exemplar(exemplar); });
}

TEST(Exemplar, IsAPictureWithALabelForEachTexel) {
  Exemplar exemplar = exemplar_of(8, 5);
  EXPECT_NO_THROW(check_exemplar(exemplar));
  exemplar.guides.label = Grid<std::uint8_t>(8, 4);
  EXPECT_THAT(refused_exemplar(exemplar),
              AllOf(HasSubstr("\"alps\""), HasSubstr("labels of 8 × 4"), HasSubstr("8 × 5")));
  exemplar.guides.label = {};
  EXPECT_THAT(refused_exemplar(exemplar), HasSubstr("no labels"));
  exemplar.picture = {};
  EXPECT_THAT(refused_exemplar(exemplar), HasSubstr("no picture"));
}

TEST(Exemplar, ItsGuidesAreCheckedAsThoseOfATarget) {
  Exemplar exemplar = exemplar_of(8, 5);
  exemplar.guides.guides = {{"tone", Grid<std::uint8_t>(5, 8)}};
  EXPECT_THAT(refused_exemplar(exemplar), AllOf(HasSubstr("\"alps\""), HasSubstr("\"tone\"")));
}

// Positions in it are stored in two numbers of 16 bits.
TEST(Exemplar, SidesHaveALimit) {
  EXPECT_NO_THROW(check_exemplar(exemplar_of(Exemplar::largest_side, 1)));
  EXPECT_NO_THROW(check_exemplar(exemplar_of(1, Exemplar::largest_side)));
  EXPECT_THAT(refused_exemplar(exemplar_of(Exemplar::largest_side + 1, 1), ErrorKind::limit),
              HasSubstr("32767"));
  EXPECT_THAT(refused_exemplar(exemplar_of(1, Exemplar::largest_side + 1), ErrorKind::limit),
              HasSubstr("32767"));
}

GuideStack stack_of(int width, int height) {
  GuideStack stack;
  stack.label = Grid<std::uint8_t>(width, height, 3);
  stack.guides = {{"altitude", Grid<std::uint8_t>(width, height, 10)},
                  {"tone", Grid<std::uint8_t>(width, height, 20)}};
  return stack;
}

std::string refused_guides(const GuideStack& stack) {
  return test::usage_error([&] { check_guide_stack(stack, "the target"); });
}

TEST(GuideStack, FindsGuidesByTheirNames) {
  const GuideStack stack = stack_of(4, 3);
  EXPECT_EQ(stack.width(), 4);
  EXPECT_EQ(stack.height(), 3);
  EXPECT_EQ(stack.find("altitude"), &stack.guides[0].values);
  EXPECT_EQ(stack.find("tone"), &stack.guides[1].values);
  EXPECT_EQ(stack.find("slope"), nullptr);
}

TEST(GuideStack, NeedsLabelsAndNothingElse) {
  GuideStack stack = stack_of(4, 3);
  EXPECT_NO_THROW(check_guide_stack(stack, "the target"));
  stack.depth_m = Grid<float>(4, 3, 1000.F);
  EXPECT_NO_THROW(check_guide_stack(stack, "the target"));
  stack.guides.clear();
  EXPECT_NO_THROW(check_guide_stack(stack, "the target"));
  EXPECT_THAT(refused_guides({}), AllOf(HasSubstr("the target"), HasSubstr("no labels")));
}

TEST(GuideStack, EveryGridIsAsLargeAsTheLabels) {
  GuideStack stack = stack_of(4, 3);
  stack.guides[1].values = Grid<std::uint8_t>(3, 4);
  EXPECT_THAT(refused_guides(stack), AllOf(HasSubstr("\"tone\" of 3 × 4"), HasSubstr("4 × 3")));
  stack = stack_of(4, 3);
  stack.depth_m = Grid<float>(4, 2);
  EXPECT_THAT(refused_guides(stack), AllOf(HasSubstr("depths of 4 × 2"), HasSubstr("4 × 3")));
}

TEST(GuideStack, EveryGuideHasANameOfItsOwn) {
  GuideStack stack = stack_of(4, 3);
  stack.guides[1].name = "altitude";
  EXPECT_THAT(refused_guides(stack), HasSubstr("two guides named \"altitude\""));
  stack.guides[1].name = "";
  EXPECT_THAT(refused_guides(stack), HasSubstr("without a name"));
}

TEST(MatchField, ReplaysAnyLayerOfItsExemplars) {
  MatchField field(3, 1);
  field(0, 0) = {0, 1, 0};
  field(1, 0) = {1, 0, 2};
  Grid<float> first(2, 1);
  Grid<float> second(1, 3);
  first(1, 0) = 0.25F;
  second(0, 2) = -7.5F;
  const Grid<float> out = replay<float>(field, {&first, &second}, Grid<float>(3, 1, 99.0F));
  EXPECT_EQ(out(0, 0), 0.25F);
  EXPECT_EQ(out(1, 0), -7.5F);
  EXPECT_EQ(out(2, 0), 99.0F) << "a pixel without match takes the value of `missing`";
  EXPECT_EQ(replay<float>(field, {&first, &second}, Grid<float>())(2, 0), 0.0F);
}

TEST(MatchField, RefusesMatchesOutsideTheLayers) {
  MatchField field(1, 1);
  Grid<int> layer(2, 2);
  field(0, 0) = {0, 2, 0};
  EXPECT_THROW(replay<int>(field, {&layer}, Grid<int>()), Error);
  field(0, 0) = {1, 0, 0};
  EXPECT_THROW(replay<int>(field, {&layer}, Grid<int>()), Error);
  field(0, 0) = {0, 1, 1};
  EXPECT_THROW(replay<int>(field, {&layer}, Grid<int>(3, 3)), Error) << "`missing` of another size";
}

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Exemplar of_labels(int width, int height, std::uint8_t label) {
  Exemplar exemplar;
  exemplar.picture = Grid<Rgb8>(width, height);
  exemplar.guides.label = Grid<std::uint8_t>(width, height, label);
  return exemplar;
}

std::string name(std::uint8_t label) { return "class " + std::to_string(label); }

TEST(ClassTexels, CountsTexelsOfAllExemplarsAndPixelsThatFallBack) {
  std::vector<Exemplar> exemplars{of_labels(10, 10, 1), of_labels(5, 4, 1), of_labels(3, 1, 2)};
  exemplars[0].guides.label(0, 0) = unused_label;
  Grid<std::uint8_t> target(20, 20, 1);
  for (int x = 0; x < 20; ++x) {
    target(x, 0) = 2;
    target(x, 1) = 7;             // has none and falls back to 2
    target(x, 2) = 9;             // has none and no fallback
    target(x, 3) = unused_label;  // needs none
  }
  const std::map<std::uint8_t, std::uint8_t> fallback{
      {7, 2}, {9, 8}, {2, 1}, {unused_label, 1}};  // 2 has texels: its own count
  const std::vector<ClassTexels> available = class_texels(exemplars, target, fallback);
  ASSERT_EQ(available.size(), 2U);
  EXPECT_EQ(available[0].label, 1);
  EXPECT_EQ(available[0].texels, 119U);
  EXPECT_EQ(available[0].pixels, 320U);
  EXPECT_TRUE(available[0].enough());
  EXPECT_EQ(available[1].label, 2);
  EXPECT_EQ(available[1].texels, 3U);
  EXPECT_EQ(available[1].pixels, 40U);
  EXPECT_FALSE(available[1].enough());
  EXPECT_EQ(available[1].texels_needed(), 10U);

  const Grid<std::uint8_t> serving = serving_labels(exemplars, target, fallback);
  EXPECT_EQ(serving(5, 0), 2);
  EXPECT_EQ(serving(5, 1), 2);
  EXPECT_EQ(serving(5, 2), unused_label);
  EXPECT_EQ(serving(5, 3), unused_label);
  EXPECT_EQ(serving(5, 4), 1);
}

TEST(ClassTexels, TheSentenceNamesOnlyScarceClassesAndTheNumberNeeded) {
  EXPECT_EQ(describe_scarcity({{1, 100, 400}}, name), "");
  const std::string text =
      describe_scarcity({{1, 100, 400}, {2, 1000, 4001}, {3, 10, 12345678}}, name);
  EXPECT_THAT(text, AllOf(HasSubstr("class 2 (each texel serves 4 pixels; 1 001 texels are "
                                    "needed, 1 000 are available)"),
                          HasSubstr("class 3 (each texel serves 1234568 pixels; 3 086 420 texels"),
                          Not(HasSubstr("class 1"))));
}

// The stated number is sufficient, and one texel less is not.
TEST(ClassTexels, TheNumberNeededIsTheLeastThatIsEnough) {
  for (std::size_t pixels = 1; pixels < 50; ++pixels) {
    const std::size_t needed = ClassTexels{1, 0, pixels}.texels_needed();
    EXPECT_TRUE((ClassTexels{1, needed, pixels}.enough()));
    EXPECT_FALSE((ClassTexels{1, needed - 1, pixels}.enough()));
  }
}

}  // namespace
}  // namespace belvedere
