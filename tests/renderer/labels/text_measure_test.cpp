#include "renderer/labels/text_measure.h"

#include <gtest/gtest.h>

#include "tests/renderer/labels/bent_text.h"

namespace belvedere {
namespace {

using test::sans;

// DejaVu's own table of widths: 1401 of 2048 units for H, 2048 units are the type's size. The font
// comes with every Debian that draws text; another machine's fonts are not known.
TEST(TextMeasure, IsTheFontsOwnWidth) {
  const TextMeasure measure;
  const TextStyle style{.family = sans, .size_px = 100.0};
  if (!TextMeasure::has_family(sans)) GTEST_SKIP() << "DejaVu is not installed";
  // Advance of H in DejaVu Sans: 1540 / 2048.
  EXPECT_NEAR(measure.measure("H", style).width_px, 100.0 * 1540.0 / 2048.0, .1);
  EXPECT_NEAR(measure.measure("HHHH", style).width_px, 400.0 * 1540.0 / 2048.0, .2);
}

TEST(TextMeasure, GrowsWithTheTypeAsItIsNotHinted) {
  const TextMeasure measure;
  const TextRoom small = measure.measure("Birkkarspitze", {.size_px = 7.3});
  const TextRoom large = measure.measure("Birkkarspitze", {.size_px = 73.0});
  EXPECT_NEAR(large.width_px, 10.0 * small.width_px, .5);
  EXPECT_NEAR(large.up_px, 10.0 * small.up_px, .5);
  EXPECT_GT(small.down_px, 0.0);
}

TEST(TextMeasure, SpacingComesBetweenLetters) {
  const TextMeasure measure;
  const double plain = measure.measure("INNTAL", {.size_px = 40.0}).width_px;
  const double spaced = measure.measure("INNTAL", {.size_px = 40.0, .spacing = .5}).width_px;
  EXPECT_GE(spaced - plain, 5 * 20.0 - 1.0);
  EXPECT_LE(spaced - plain, 6 * 20.0 + 12.0) << "kerning is off between spaced letters";
}

TEST(TextMeasure, AnyScriptAndNothingHaveARoom) {
  const TextMeasure measure;
  for (const char* text : {"Großglockner", "जंगल", "شاهو", "富士山", "Ćićarija"})
    EXPECT_GT(measure.measure(text, {.size_px = 20.0}).width_px, 10.0) << text;
  EXPECT_EQ(measure.measure("", {.size_px = 20.0}).width_px, 0.0);
}

TEST(TextMeasure, TakesTheFirstFamilyThatIsThere) {
  if (!TextMeasure::has_family(sans)) GTEST_SKIP() << "DejaVu is not installed";
  const TextMeasure measure;
  EXPECT_DOUBLE_EQ(measure.measure("Inn", {.family = "No Such Font At All, DejaVu Sans"}).width_px,
                   measure.measure("Inn", {.family = sans}).width_px);
  EXPECT_TRUE(TextMeasure::has_family("No Such Font At All, DejaVu Sans"));
  EXPECT_FALSE(TextMeasure::has_family("No Such Font At All, Nor This"));
  EXPECT_TRUE(TextMeasure::has_family("serif")) << "whatever the system has";
}

TEST(TextMeasure, CapitalsAreThoseOfEveryScriptAndNoLanguage) {
  EXPECT_EQ(capitals("Großes Öd, Inn"), "GROSSES ÖD, INN");
  EXPECT_EQ(capitals("Ťažký štít Пик"), "ŤAŽKÝ ŠTÍT ПИК");
  EXPECT_EQ(capitals("御嶽山 جبل"), "御嶽山 جبل");
}

}  // namespace
}  // namespace belvedere
