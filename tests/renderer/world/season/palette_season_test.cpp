#include "renderer/world/season/palette_season.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

using enum LandCoverClass;

TEST(PaletteSeason, AltitudesMoveAndSingleRampsStay) {
  const Palette summer = read_palette("summer");
  const Palette moved = palette_at_other_altitudes(summer, 800.0);
  for (const double altitude : {500.0, 1200.0, 1900.0, 2600.0}) {
    EXPECT_EQ(palette_colour(moved, forest, altitude + 800.0, 0.5),
              palette_colour(summer, forest, altitude, 0.5));
    EXPECT_EQ(palette_colour(moved, alpine_grass, altitude + 800.0, 0.5),
              palette_colour(summer, alpine_grass, altitude, 0.5));
  }
  EXPECT_NE(palette_colour(moved, forest, 900.0, 0.5), palette_colour(summer, forest, 900.0, 0.5));
  EXPECT_EQ(palette_colour(moved, rock, 900.0, 0.5), palette_colour(summer, rock, 900.0, 0.5));
}

TEST(PaletteSeason, MixesByAltitude) {
  const Palette summer = read_palette("summer");
  const Palette autumn = read_palette("autumn");
  const auto share = [](double altitude_m) {
    return altitude_m < 1000.0 ? 0.0 : altitude_m < 2000.0 ? (altitude_m - 1000.0) / 1000.0 : 1.0;
  };
  const Palette mixed = mix_palettes(summer, autumn, share, 400.0, 3000.0);
  for (const double tone : {0.0, 0.5, 1.0}) {
    const auto near = [&](glm::vec3 a, glm::vec3 b) {
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 2e-3F);
    };
    near(palette_colour(mixed, pasture, 700.0, tone), palette_colour(summer, pasture, 700.0, tone));
    near(palette_colour(mixed, pasture, 2500.0, tone),
         palette_colour(autumn, pasture, 2500.0, tone));
    near(palette_colour(mixed, forest, 1500.0, tone),
         0.5F * (palette_colour(summer, forest, 1500.0, tone) +
                 palette_colour(autumn, forest, 1500.0, tone)));
  }
  // Colours without altitude lie halfway between the shares of the lowest and the highest ground.
  EXPECT_NEAR(mixed.growth.leaf_share, 0.5 * (summer.growth.leaf_share + autumn.growth.leaf_share),
              1e-9);
  EXPECT_FALSE(mixed.winter);
}

// The sky has no altitude: half of both where every ground has half of both.
TEST(PaletteSeason, TheSkyIsMixedAtEveryHeight) {
  Palette low = read_palette("summer"), high = low;
  const glm::vec3 black(0.F), grey(0.4F), white(1.F);
  low.sky = {{0.0, black}, {0.5, black}, {1.0, white}};
  high.sky = {{0.25, white}, {0.75, grey}};
  const Palette mixed = mix_palettes(
      low, high, [](double) { return 0.5; }, 400.0, 3000.0);
  ASSERT_EQ(mixed.sky.size(), 3U);
  EXPECT_FLOAT_EQ(mixed.sky[0].second.x, 0.5F);
  EXPECT_FLOAT_EQ(mixed.sky[1].second.x, 0.35F);  // half of black, half of (white + grey) / 2
  EXPECT_FLOAT_EQ(mixed.sky[2].second.x, 0.7F);
}

TEST(PaletteSeason, NothingOfTheSecondIsTheFirst) {
  const Palette summer = read_palette("summer");
  const Palette same = mix_palettes(
      summer, read_palette("autumn"), [](double) { return 0.0; }, 500.0, 3000.0);
  for (const double altitude : {600.0, 1234.0, 2800.0})
    for (const LandCoverClass id : {forest, pasture, alpine_grass, rock})
      EXPECT_NEAR(palette_colour(same, id, altitude, 0.4).x,
                  palette_colour(summer, id, altitude, 0.4).x, 1e-6F);
  EXPECT_EQ(same.sky, summer.sky);
}

}  // namespace
}  // namespace belvedere
