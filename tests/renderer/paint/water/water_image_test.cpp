#include "renderer/paint/water/water_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/grid.h"
#include "renderer/paint/base_picture.h"
#include "renderer/paint/palette.h"
#include "renderer/paint/sky.h"
#include "tests/grids.h"
#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

TEST(WaterImage, FresnelHasItsKnownValues) {
  EXPECT_NEAR(water_fresnel(1.0), std::pow(0.333 / 2.333, 2.0), 1e-12);
  EXPECT_NEAR(water_fresnel(0.0), 1.0, 1e-12);
  // At Brewster's angle only one polarization is reflected: half of ((n² - 1) / (n² + 1))².
  const double n2 = 1.333 * 1.333;
  EXPECT_NEAR(water_fresnel(1.0 / std::sqrt(1.0 + n2)),
              0.5 * std::pow((n2 - 1.0) / (n2 + 1.0), 2.0), 1e-12);
  EXPECT_NEAR(water_fresnel(0.5), 0.0597, 5e-4);  // 60° from the normal
  for (double c = 0.0; c < 1.0; c += 0.02) EXPECT_GT(painted_mirror(c), painted_mirror(c + 0.02));
  EXPECT_NEAR(painted_mirror(0.5), std::pow(water_fresnel(0.5), 0.4), 1e-9);
}

constexpr int width = 12;
constexpr int height = 160;

// Water everywhere, 20 km away, seen at 60° from its normal; the upper half reflects a lit forest,
// the lower the sky.
struct FarLake {
  GuidanceBuffers guidance;
  MirrorSight sight;
  Palette palette = read_palette("summer");
  WaterImageParameters parameters;
  FarLake() {
    guidance.depth_m = Grid<float>(width, height, 20000.0F);
    guidance.footprint_m = Grid<float>(width, height, 8.0F);
    guidance.altitude_m = Grid<float>(width, height, 900.0F);
    guidance.land_cover = Grid<LandCoverClass>(width, height, LandCoverClass::water);
    sight.cosine = sight.rise = Grid<float>(width, height, 0.5F);
    sight.distance_m = Grid<float>(width, height, 20000.0F);
    sight.path_m = Grid<float>(width, height, std::numeric_limits<float>::infinity());
    sight.land_cover = Grid<LandCoverClass>(width, height, LandCoverClass::sky);
    sight.altitude_m = Grid<float>(width, height, 1000.0F);
    sight.normal = Grid<glm::vec3>(width, height, glm::vec3(0.0F, 0.0F, 1.0F));
    sight.shadow = Grid<float>(width, height, 1.0F);
    for (const auto [x, y] : test::cells(width, height / 2)) {
      sight.path_m(x, y) = 400.0F;
      sight.land_cover(x, y) = LandCoverClass::forest;
    }
  }
  WaterImage paint(PixelRect wanted = {0, 0, width, height}) const {
    return paint_water_image(sight, {0, 0, width, height}, guidance, palette, parameters, wanted);
  }
};

TEST(WaterImage, MirrorsLandDarkAndSkyByItsHeight) {
  const FarLake lake;
  const WaterImage image = lake.paint();
  EXPECT_NEAR(image.land(4, 10), 1.0F, 1e-6F);
  EXPECT_NEAR(image.land(4, height - 10), 0.0F, 1e-6F);
  EXPECT_NEAR(image.share(4, height - 10), painted_mirror(0.5), 1e-5);
  EXPECT_NEAR(image.share(4, 10), 1.5 * painted_mirror(0.5), 1e-5);
  const glm::vec3 sky = sky_gradient(lake.palette, 1.0 - 0.5 / 0.8) * 0.93F;  // of its blue
  EXPECT_NEAR(image.colour(4, height - 10).b, sky.b, 1e-5F);
  EXPECT_NEAR(image.sky(4, 10).b, sky.b, 1e-6F) << "what ruffled water shows in the land's image";
  // Lit forest, darker and bluer than itself: within its ramp.
  EXPECT_LT(image.colour(4, 10).r,
            0.67F * palette_colour(lake.palette, LandCoverClass::forest, 1000.0, 1.0).r);
  EXPECT_GT(image.colour(4, 10).r,
            0.65F * palette_colour(lake.palette, LandCoverClass::forest, 1000.0, 0.3).r);
}

TEST(WaterImage, TheImageOfAShadyBankIsDarker) {
  FarLake shady;
  for (float& lit : shady.sight.shadow) lit = 0.0F;
  EXPECT_LT(shady.paint().colour(4, 10).g, FarLake().paint().colour(4, 10).g - 0.05F);
}

TEST(WaterImage, FarThingsStandInTheAirOfTheWholeWay) {
  FarLake far;
  for (const auto [x, y] : test::cells(width, height / 2)) far.sight.path_m(x, y) = 80000.0F;
  const glm::vec3 near_wood = FarLake().paint().colour(4, 10);
  const glm::vec3 far_wood = far.paint().colour(4, 10);
  EXPECT_GT(far_wood.b, near_wood.b + 0.1F);
}

// Waves turn rays by about .06 rad: over 400 m of 20400 by .0012 rad, with 2500 pixels per rad, so
// by about 3 px.
TEST(WaterImage, IsDrawnOutDownwardsByWhatLiesFarFromTheWater) {
  FarLake lake;
  const auto border_rows = [&](float path_m) {
    for (const auto [x, y] : test::cells(width, height / 2)) lake.sight.path_m(x, y) = path_m;
    const WaterImage image = lake.paint();
    int mixed = 0;
    for (int y = 0; y < height / 2; ++y) mixed += image.land(4, y) < 0.999F ? 1 : 0;
    return mixed;
  };
  EXPECT_LE(border_rows(10.0F), 2);
  EXPECT_GE(border_rows(400.0F), 4);
  EXPECT_GT(border_rows(2000.0F), border_rows(400.0F));
  EXPECT_LE(border_rows(50000.0F), water_image_margin_px(1.0));
}

TEST(WaterImage, APartIsThatOfTheWhole) {
  FarLake lake;
  for (const auto [x, y] : test::cells(width, height)) {
    if (x == 3 && y % 7 == 0) lake.guidance.land_cover(x, y) = LandCoverClass::pasture;
    lake.sight.path_m(x, y) += static_cast<float>((x * 37 + y * 91) % 700);
  }
  const WaterImage whole = lake.paint();
  const PixelRect wanted{2, 60, 9, 90};
  const int margin = water_image_margin_px(1.0);
  const PixelRect rect{2, 60 - margin, 9, 90 + margin};
  const MirrorSight part{.cosine = part_of(lake.sight.cosine, rect),
                         .distance_m = part_of(lake.sight.distance_m, rect),
                         .path_m = part_of(lake.sight.path_m, rect),
                         .rise = part_of(lake.sight.rise, rect),
                         .land_cover = part_of(lake.sight.land_cover, rect),
                         .altitude_m = part_of(lake.sight.altitude_m, rect),
                         .normal = part_of(lake.sight.normal, rect),
                         .shadow = part_of(lake.sight.shadow, rect)};
  const WaterImage some =
      paint_water_image(part, rect, lake.guidance, lake.palette, lake.parameters, wanted);
  EXPECT_TRUE(some.colour == part_of(whole.colour, wanted));
  EXPECT_TRUE(some.share == part_of(whole.share, wanted));
  EXPECT_TRUE(some.land == part_of(whole.land, wanted));
  EXPECT_TRUE(some.sky == part_of(whole.sky, wanted));
  EXPECT_EQ(whole.share(3, 63), 0.0F) << "land mirrors nothing";
  EXPECT_THROW(
      paint_water_image(part, rect, lake.guidance, lake.palette, lake.parameters, {0, 0, width, 9}),
      Error);
}

TEST(WaterImage, StrengthIsTheScenes) {
  FarLake lake;
  lake.parameters.strength = 0.0;
  for (const float share : lake.paint().share) ASSERT_EQ(share, 0.0F);
}

// Forest in shade down to row 60, a lake in rows 60…109, meadow below it.
GuidanceBuffers lake() {
  GuidanceBuffers g = test::make_slope(80, 140, LandCoverClass::forest, {0.0F, 0.0F, 1.0F}, 20.0F);
  for (const auto [x, y] : test::cells(80, 140)) {
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
  for (const auto [x, y] : test::cells(80, 60))
    g.depth_m(x, y) = 12000.0F;  // a crag nearer than the lake
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
  for (const auto [x, y] : test::cells({0, 50, 80, 60})) {
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
  for (const auto [x, y] : test::cells(rect)) {
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
