#include "renderer/trace/wide_view.h"

#include <gtest/gtest.h>

#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

constexpr int factor = 4;

// A level picture whose depth is the same everywhere.
GuidanceBuffers level_view(int width, int height) {
  return test::make_slope(width, height, LandCoverClass::rock, {0.0F, 0.3F, 1.0F}, 45.0F);
}

TEST(WideView, LeavesTwoPixelsToAUnit) {
  EXPECT_EQ(wide_factor(0.3), 1);
  EXPECT_EQ(wide_factor(1.04), 1);
  EXPECT_EQ(wide_factor(3.99), 1);
  EXPECT_EQ(wide_factor(4.0), 2);
  EXPECT_EQ(wide_factor(8.34), 4);
}

TEST(WideView, APixelOfTheSheetLiesInOneOfIts) {
  const GuidanceBuffers g = level_view(10, 6);
  const WideView wide{g, factor, {5, 2}};
  EXPECT_EQ(wide.column(20), 0);
  EXPECT_EQ(wide.column(23), 0);
  EXPECT_EQ(wide.column(24), 1);
  EXPECT_EQ(wide.column(3), 0) << "the nearest there is";
  EXPECT_EQ(wide.column(1000), 9);
  EXPECT_EQ(wide.row(11), 0);
  EXPECT_EQ(wide.row(12), 1);
  EXPECT_TRUE(wide.holds(20, 8));
  EXPECT_TRUE(wide.holds(59, 31));
  EXPECT_FALSE(wide.holds(19, 8));
  EXPECT_FALSE(wide.holds(60, 31));
  EXPECT_FALSE(wide.holds(20, 7));
}

TEST(WideView, ItsRectangleHoldsWhatLiesBetween) {
  for (const PixelRect rect :
       {PixelRect{0, 0, 1, 1}, PixelRect{17, 30, 41, 33}, PixelRect{-9, -4, 8, 3}}) {
    const PixelRect wide = wide_rect(rect, factor);
    EXPECT_LE((wide.x0 + 0.5) * factor, rect.x0 + 0.5);
    EXPECT_LE((wide.y0 + 0.5) * factor, rect.y0 + 0.5);
    EXPECT_GE((wide.x1 - 0.5) * factor, rect.x1 - 0.5);
    EXPECT_GE((wide.y1 - 0.5) * factor, rect.y1 - 0.5);
  }
}

}  // namespace
}  // namespace belvedere
