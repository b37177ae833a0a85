#include "renderer/paint/reflection.h"

#include <gtest/gtest.h>

#include "renderer/paint/base_picture.h"
#include "renderer/paint/palette.h"
#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

// Forest in shade down to row 60, a lake in rows 60…109, meadow below it.
GuidanceBuffers lake() {
  GuidanceBuffers g = test::make_slope(80, 140, LandCoverClass::forest, {0.0F, 0.0F, 1.0F}, 20.0F);
  for (int y = 0; y < 140; ++y)
    for (int x = 0; x < 80; ++x) {
      g.tone(x, y) = y < 60 ? 0.2F : 0.6F;
      if (y >= 60) g.land_cover(x, y) = y < 110 ? LandCoverClass::water : LandCoverClass::pasture;
    }
  return g;
}

TEST(Reflection, ShowsTheFarShoreUpsideDown) {
  const GuidanceBuffers g = lake();
  const Mirrored m = find_reflections(g, 1.0);
  EXPECT_EQ(m.source(40, 60),
            g.depth_m.index(40, 58));  // 1.25 rows above the last row of forest, rounded
  EXPECT_EQ(m.source(40, 67), g.depth_m.index(40, 59 - 10));
  EXPECT_EQ(m.source(40, 59), -1);
  EXPECT_EQ(m.source(40, 109), -1) << "beyond its reach water shows the sky";
  EXPECT_GT(m.share(40, 61), 0.8F);
  EXPECT_LT(m.share(40, 70), m.share(40, 62));
  EXPECT_EQ(m.share(40, 100), 0.0F);
}

TEST(Reflection, IsNotOfWhatStandsBeforeTheWater) {
  GuidanceBuffers g = lake();
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) g.depth_m(x, y) = 12000.0F;  // a crag nearer than the lake
  const Mirrored m = find_reflections(g, 1.0);
  for (int y = 60; y < 110; ++y) EXPECT_EQ(m.source(40, y), -1);
}

TEST(Reflection, DarkensTheWaterBelowADarkShore) {
  GuidanceBuffers g = lake();
  BaseParameters p;
  p.air.haze = p.air.range_mist = p.air.warm_near = p.air.hue_drift = p.air.clouds = 0.0;
  const BasePicture base =
      make_base_picture(g, read_palette("summer"), p, {0, 0}, {80, 140}, silent_progress());
  double near_shore = 0.0;
  double open = 0.0;
  for (int x = 0; x < 80; ++x) {
    near_shore += base.colour(x, 64).g / 80.0;
    open += base.colour(x, 95).g / 80.0;
  }
  EXPECT_LT(near_shore, open - 0.1);
}

TEST(Reflection, IsOfTheSlopeBehindALevelMeadow) {
  GuidanceBuffers g = lake();
  for (int y = 50; y < 60; ++y)
    for (int x = 0; x < 80; ++x) {
      g.land_cover(x, y) = LandCoverClass::pasture;
      g.slope_deg(x, y) = 1.0F;
    }
  const Mirrored m = find_reflections(g, 1.0);
  EXPECT_EQ(m.source(40, 67), g.depth_m.index(40, 49 - 10));
  EXPECT_LT(m.share(40, 62), find_reflections(lake(), 1.0).share(40, 62));
  EXPECT_GT(m.share(40, 62), 0.3F);
  // Level as far as it is searched: only sky.
  for (float& slope : g.slope_deg) slope = 1.0F;
  EXPECT_EQ(find_reflections(g, 1.0).source(40, 62), -1);
}

TEST(Reflection, KnowsBothShores) {
  const Mirrored m = find_reflections(lake(), 2.0);  // two pixels per unit
  EXPECT_FLOAT_EQ(m.to_far(40, 65), 3.0F);           // row 59 is land
  EXPECT_FLOAT_EQ(m.to_near(40, 65), 22.5F);         // row 110 is
  EXPECT_EQ(m.to_near(40, 50), open_water);
}

TEST(Reflection, WaterIsPalerFarAwayWithADarkLineUnderTheShoreAndAPaleOneBeforeUs) {
  GuidanceBuffers g = lake();
  for (float& slope : g.slope_deg) slope = 1.0F;  // no image
  BaseParameters p;
  p.air.haze = p.air.range_mist = p.air.warm_near = p.air.hue_drift = p.air.clouds = 0.0;
  const BasePicture base =
      make_base_picture(g, read_palette("summer"), p, {0, 0}, {80, 140}, silent_progress());
  // Means over some rows: streaks of wind are independent of them.
  const auto rows = [&](int first, int last) {
    double sum = 0.0;
    for (int y = first; y <= last; ++y)
      for (int x = 0; x < 80; ++x) sum += base.colour(x, y).r / 80.0;
    return sum / (last - first + 1);
  };
  EXPECT_LT(rows(60, 60), rows(62, 72) - 0.05);
  EXPECT_GT(rows(62, 72), rows(90, 102) + 0.05);
  EXPECT_GT(rows(109, 109), rows(100, 106) + 0.05);
}

TEST(Reflection, PartEqualsWhole) {
  const GuidanceBuffers whole = test::make_hills(300, 260);
  const Mirrored all = find_reflections(whole, 1.0);
  const int margin = reflection_margin_px(1.0);
  const PixelRect rect{100, 120, 180, 170};
  const PixelRect part = test::with_margin(rect, margin, 300, 260);
  const Mirrored some = find_reflections(test::cut(whole, part), 1.0);
  int water = 0;
  for (int y = rect.y0; y < rect.y1; ++y)
    for (int x = rect.x0; x < rect.x1; ++x) {
      ASSERT_EQ(some.share(x - part.x0, y - part.y0), all.share(x, y));
      ASSERT_EQ(some.to_far(x - part.x0, y - part.y0), all.to_far(x, y));
      ASSERT_EQ(some.to_near(x - part.x0, y - part.y0), all.to_near(x, y));
      if (all.source(x, y) < 0) continue;
      ++water;
      const int source_x = all.source(x, y) % 300 - part.x0;
      const int source_y = all.source(x, y) / 300 - part.y0;
      ASSERT_EQ(some.source(x - part.x0, y - part.y0), source_y * part.width() + source_x);
    }
  EXPECT_GT(water, 0);
}

}  // namespace
}  // namespace belvedere
