#include "renderer/labels/placed_text.h"

#include <gtest/gtest.h>

#include "tests/renderer/labels/bent_text.h"

namespace belvedere {
namespace {

using test::bent;
using test::sans;

// The first of Hebrew letters stands at the right.
TEST(PlacedText, KnowsWhichLettersStandWhere) {
  const TextMeasure measure;
  if (!TextMeasure::has_family(sans)) GTEST_SKIP() << "DejaVu is not installed";
  const std::vector<PlacedLetter> hebrew = place_letters(bent("הר חרמון"), measure);
  ASSERT_EQ(hebrew.size(), 8U);
  EXPECT_EQ(hebrew.back().letter.text, "ה");
  EXPECT_EQ(hebrew.front().letter.text, "ן");
  EXPECT_GT(hebrew.back().at.x, hebrew.front().at.x + 100.0);
}

TEST(PlacedText, NothingStandsOnALineThatIsTooShort) {
  EXPECT_TRUE(
      place_letters(bent("Ein viel zu langer Name für diese kurze Linie"), TextMeasure()).empty());
}

}  // namespace
}  // namespace belvedere
