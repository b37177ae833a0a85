#include "renderer/paint/air.h"

#include <gtest/gtest.h>

#include <cmath>

namespace belvedere {
namespace {

TEST(Haze, GrowsWithDistanceAndSaturates) {
  const AirParameters p;
  EXPECT_EQ(haze_share(p, 0.0, 600.0), 0.0);
  EXPECT_EQ(haze_share(p, p.from_m, 600.0), 0.0);
  double last = 0.0;
  for (double depth = 40000.0; depth < 400000.0; depth += 20000.0) {
    EXPECT_GT(haze_share(p, depth, 600.0), last);
    last = haze_share(p, depth, 600.0);
  }
  EXPECT_NEAR(haze_share(p, p.from_m + p.scale_m, 600.0), 0.85 * (1.0 - std::exp(-1.0)), 1e-12);
  EXPECT_NEAR(haze_share(p, p.from_m + 0.5 * p.scale_m, 600.0),
              0.85 * (1.0 - std::exp(-std::pow(0.5, 1.35))), 1e-12);
  EXPECT_NEAR(haze_share(p, 1e7, 600.0), 0.85, 1e-9);
  EXPECT_NEAR(haze_share(p, 1e7, 600.0 + 900.0), 0.85 * (0.58 + 0.42 * std::exp(-1.0)), 1e-9);
}

TEST(Haze, MakesRangesFar) {
  const AirParameters p;
  EXPECT_EQ(far_range_share(p, p.from_m, 600.0), 0.0F);
  EXPECT_EQ(far_range_share(p, p.from_m + p.scale_m, 600.0), 1.0F);
  float last = 0.0F;
  for (double depth = p.from_m; depth < p.from_m + p.scale_m; depth += 2000.0) {
    EXPECT_GE(far_range_share(p, depth, 600.0), last);
    last = far_range_share(p, depth, 600.0);
  }
  EXPECT_LT(far_range_share(p, 70000.0, 3000.0), far_range_share(p, 70000.0, 600.0));
}

TEST(Haze, IsThickenedAmongFarRangesAndThinnerOnTheirCrests) {
  const AirParameters p;
  const Palette palette = read_palette("summer");
  const auto share = [&](float far, float raised) {
    return static_cast<double>(air_share(p, palette, 70000.0, 600.0, far, raised));
  };
  const double plain = haze_share(p, 70000.0, 600.0);
  EXPECT_NEAR(share(0.0F, 0.0F), plain, 1e-6);
  EXPECT_EQ(share(0.0F, 1.0F), share(0.0F, -1.0F))
      << "near the viewer, crest and foot have the same air";
  EXPECT_NEAR(share(1.0F, 0.0F), plain + 0.34 * (1.0 - plain), 1e-6);
  const double crest = 0.7 * plain - 0.06;
  EXPECT_NEAR(share(1.0F, 1.0F), crest + 0.34 * (1.0 - crest), 1e-6);
  EXPECT_EQ(share(1.0F, -1.0F), share(1.0F, 0.0F)) << "no foot dissolves under its mountain";
  Palette clear = palette;
  clear.haze_share = 0.0;
  EXPECT_EQ(air_share(p, clear, 70000.0, 600.0, 1.0F, 0.0F), 0.0F);
}

TEST(Haze, FarnessBeginsBehindTheForeground) {
  const AirParameters p;
  EXPECT_EQ(farness(p, p.from_m + 0.3 * p.scale_m), 0.0F);
  EXPECT_NEAR(farness(p, p.from_m + 0.55 * p.scale_m), 0.5F, 1e-6F);
  EXPECT_EQ(farness(p, p.from_m + p.scale_m), 1.0F);
}

TEST(Air, TurnsFromItsNearToItsFarColour) {
  const AirParameters p;
  const Palette palette = read_palette("summer");
  EXPECT_EQ(air_colour(p, palette, 0.0), palette.haze_near);
  EXPECT_EQ(air_colour(p, palette, 1e6), palette.haze_far);
  const double centre_m = 0.5 * (0.88 * p.from_m + p.from_m + 1.06 * p.scale_m);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(air_colour(p, palette, centre_m)[k],
                0.5F * (palette.haze_near[k] + palette.haze_far[k]), 1e-6F);
}

TEST(Air, WarmthEndsWhereGreensHaveGoneStale) {
  const AirParameters p;
  EXPECT_EQ(foreground_warmth(p, 0.82 * p.from_m), 1.0F);
  EXPECT_NEAR(foreground_warmth(p, (0.82 + 0.515) * p.from_m), 0.5F, 1e-6F);
  EXPECT_EQ(foreground_warmth(p, 1.86 * p.from_m), 0.0F);
  EXPECT_EQ(green_desaturation(p, 0.75 * p.from_m), 0.0F);
  EXPECT_NEAR(green_desaturation(p, 1.125 * p.from_m), 0.5F, 1e-6F);
  EXPECT_EQ(green_desaturation(p, 1.5 * p.from_m), 1.0F);
  EXPECT_EQ(foreground_warmth({.from_m = 0.0}, 10.0), 0.0F)
      << "air from the eye on leaves no foreground";
  EXPECT_EQ(green_desaturation({.from_m = 0.0}, 10.0), 0.0F);
}

}  // namespace
}  // namespace belvedere
