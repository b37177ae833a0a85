#include "renderer/labels/placed_text.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

constexpr const char* sans = "DejaVu Sans";

DrawnText bent(const std::string& words) {
  return {.text = words,
          .type = {.family = sans, .size_px = 40.0},
          .colour = "#102040",
          .along = {{20, 180}, {150, 120}, {300, 100}, {450, 120}, {580, 180}}};
}

// The first of Hebrew letters stands at the right.
TEST(PlacedText, KnowsWhichLettersStandWhere) {
  const TextMeasure measure;
  if (measure.family_of({.family = sans}) != sans) GTEST_SKIP() << "DejaVu is not installed";
  const std::vector<PlacedLetter> hebrew = place_letters(bent("הר חרמון"), measure);
  ASSERT_EQ(hebrew.size(), 8U);
  EXPECT_EQ(hebrew.back().letter.text, "ה");
  EXPECT_EQ(hebrew.front().letter.text, "ן");
  EXPECT_GT(hebrew.back().at.x, hebrew.front().at.x + 100.0);
}

TEST(PlacedText, NothingStandsOnALineThatIsTooShort) {
  EXPECT_TRUE(place_letters(bent("Ein viel zu langer Name für diese kurze Linie"), TextMeasure()).empty());
}

}  // namespace
}  // namespace belvedere
