#include "renderer/press/palette_press.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/renderer/image/icc/press_profile.h"

namespace belvedere {
namespace {

TEST(PalettePress, FindsTheColourThatNoInksMake) {
  Palette palette = read_palette("summer");
  ClassPalette& pasture = palette.classes[static_cast<std::size_t>(LandCoverClass::pasture)];
  pasture.stops = {{1234.0, ToneRamp{glm::vec3(0.3F), glm::vec3(0.5F), glm::vec3(0.0F, 1.0F, 0.0F),
                                     glm::vec3(0.9F)}}};
  const std::vector<PaletteColour> colours = print_palette(palette, test::press_profile());
  const auto found = std::find_if(colours.begin(), colours.end(), [](const PaletteColour& one) {
    return one.where == "pasture at 1234 m, tone 0.66";
  });
  ASSERT_NE(found, colours.end());
  EXPECT_GT(found->delta_e, 10.0);
  EXPECT_GT(found->printed.x, 0.05F);
  EXPECT_LT((found - 1)->delta_e, 2.0) << "a grey";
  EXPECT_LT((found + 1)->delta_e, 2.0);
}

// Each ramp has its four tones at each altitude; sky is no ramp.
TEST(PalettePress, HasEveryColourOfThePalette) {
  const Palette palette = read_palette("winter");
  std::size_t expected = palette.sky.size() + 5 + palette.growth.leaves.size() +
                         (palette.growth.larch_share > 0.0 ? 1 : 0);
  for (const ClassPalette& one : palette.classes) expected += 4 * one.stops.size();
  EXPECT_EQ(print_palette(palette, test::press_profile()).size(), expected);
}

}  // namespace
}  // namespace belvedere
