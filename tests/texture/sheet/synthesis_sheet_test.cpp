#include "texture/sheet/synthesis_sheet.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace belvedere {
namespace {

TEST(SynthesisSheet, PlanIsTheLargestHalvingThatFits) {
  EXPECT_EQ(divide_sheet(2000, 2000).level, 0) << "4 million pixels are allowed";
  EXPECT_EQ(divide_sheet(2001, 2000).level, 1);
  const SynthesisSheet print = divide_sheet(20000, 8000);
  EXPECT_EQ(print.level, 3);
  EXPECT_EQ(print.plan_width(), 2500);
  EXPECT_EQ(print.plan_height(), 1000);
  EXPECT_EQ(divide_sheet(40000, 16000).level, 4);
  EXPECT_EQ(divide_sheet(101, 99, 26 * 25).level, 2) << "sides are rounded up";
  EXPECT_EQ(divide_sheet(101, 99, 26 * 25 - 1).level, 3);
  EXPECT_THROW(divide_sheet(100000, 100000, 1000), Error);
}

TEST(SynthesisSheet, TilesCoverItWithoutOverlap) {
  const SynthesisSheet sheet{2049, 1000, 2, 1024};
  ASSERT_EQ(sheet.columns(), 3);
  ASSERT_EQ(sheet.rows(), 1);
  EXPECT_EQ(sheet.tile(0, 0), (PixelRect{0, 0, 1024, 1000}));
  EXPECT_EQ(sheet.tile(2, 0), (PixelRect{2048, 0, 2049, 1000}));
}

TEST(SynthesisSheet, WindowHasTheMarginInsideTheSheet) {
  EXPECT_EQ(synthesis_margin_px(0), 0);
  EXPECT_EQ(synthesis_margin_px(1), 18);
  EXPECT_EQ(synthesis_margin_px(3), 72);
  const SynthesisSheet sheet{3000, 2000, 3, 1024};
  EXPECT_EQ(synthesis_window(sheet, sheet.tile(1, 1)),
            (PixelRect{1024 - 72, 1024 - 72, 2048 + 72, 2000}));
  EXPECT_EQ(synthesis_window(sheet, sheet.tile(0, 0)), (PixelRect{0, 0, 1024 + 72, 1024 + 72}));
}

}  // namespace
}  // namespace belvedere
