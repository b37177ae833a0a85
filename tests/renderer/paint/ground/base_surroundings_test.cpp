#include "renderer/paint/ground/base_surroundings.h"

#include <gtest/gtest.h>

#include "tests/grids.h"
#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

BaseSurroundings around(const GuidanceBuffers& g) {
  return look_around(g, {g, 1, {0, 0}}, read_palette("summer"), {}, {{g.width(), g.height()}, 4.0},
                     {0, 0}, {0, 0, g.width(), g.height()});
}

GuidanceBuffers meadow() {
  return test::make_slope(160, 24, LandCoverClass::pasture, {0.0F, 0.0F, 1.0F}, 10.0F);
}

TEST(BaseSurroundings, GroundWithoutWaterAndIceSkipsWhatTheyNeed) {
  const BaseSurroundings s = around(meadow());
  EXPECT_TRUE(s.bare.empty());
  EXPECT_TRUE(s.streaks.empty());
  for (const float share : s.water) EXPECT_EQ(share, 0.0F);
  for (const float share : s.wood) EXPECT_EQ(share, 0.0F);
}

// The edge of a wood lies in the middle of the belt of dwarf pine.
TEST(BaseSurroundings, WoodIsTheShareOfForestAround) {
  GuidanceBuffers g = meadow();
  for (const auto [x, y] : test::cells(80, 24)) g.land_cover(x, y) = LandCoverClass::forest;
  const BaseSurroundings s = around(g);
  EXPECT_GT(s.wood(10, 12), 0.99F);
  EXPECT_NEAR(0.5F * (s.wood(79, 12) + s.wood(80, 12)), 0.5F, 0.01F);
  EXPECT_LT(s.wood(150, 12), 0.01F);
}

TEST(BaseSurroundings, WaterIsABrookWhereItIsNarrow) {
  GuidanceBuffers g = meadow();
  for (int y = 0; y < 24; ++y) {
    g.land_cover(20, y) = LandCoverClass::water;
    for (int x = 60; x < 120; ++x) g.land_cover(x, y) = LandCoverClass::water;
  }
  const BaseSurroundings s = around(g);
  EXPECT_LT(s.water(20, 12), 0.4F);
  EXPECT_GT(s.water(90, 12), 0.99F);
}

TEST(BaseSurroundings, WaterIsReadUpAndDownAndNothingBeyondTheMargin) {
  const PixelRect wanted{100, 100, 140, 130};
  const BaseParameters p;
  const PixelRect dry = base_window(wanted, false, p), wet = base_window(wanted, true, p);
  EXPECT_EQ(wet.x0, dry.x0);
  EXPECT_EQ(wet.x1, dry.x1);
  EXPECT_LT(wet.y0, dry.y0);
  EXPECT_GT(wet.y1, dry.y1);
  EXPECT_LE(wanted.y0 - wet.y0, base_margin_px(p));
  EXPECT_LE(wet.y1 - wanted.y1, base_margin_px(p));
}

}  // namespace
}  // namespace belvedere
