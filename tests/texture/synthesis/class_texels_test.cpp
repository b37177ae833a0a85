#include "texture/synthesis/class_texels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace belvedere {
namespace {

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
