#include "renderer/paint/palette.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "base/error.h"
#include "tests/files.h"
#include "tests/renderer/paint/near_colours.h"

namespace belvedere {
namespace {

using test::expect_near;
using testing::HasSubstr;

glm::vec3 rgb(unsigned code) {
  return glm::vec3((code >> 16) & 255U, (code >> 8) & 255U, code & 255U) / 255.0F;
}

std::string error_of(const std::string& text) {
  return test::usage_error([&] { parse_palette(text, "test.toml"); });
}

TEST(Palette, RampIsExactAtItsStops) {
  const Palette summer = read_palette("summer");
  expect_near(palette_colour(summer, LandCoverClass::rock, 2000.0, 0.0), rgb(0x475280));
  expect_near(palette_colour(summer, LandCoverClass::rock, 2000.0, 0.34), rgb(0x7c7998));
  expect_near(palette_colour(summer, LandCoverClass::rock, 2000.0, 0.66), rgb(0xc6b8ae));
  expect_near(palette_colour(summer, LandCoverClass::rock, 2000.0, 1.0), rgb(0xfdf2e4));
  expect_near(palette_colour(read_palette("winter"), LandCoverClass::snow, 2300.0, 0.34),
              rgb(0xa9b8e0));
}

TEST(Palette, RampIsLinearBetweenStopsAndFlatBeyond) {
  const Palette summer = read_palette("summer");
  expect_near(palette_colour(summer, LandCoverClass::rock, 0.0, 0.5),
              0.5F * (rgb(0x7c7998) + rgb(0xc6b8ae)));
  expect_near(palette_colour(summer, LandCoverClass::rock, 0.0, 1.4), rgb(0xfdf2e4));
  expect_near(palette_colour(summer, LandCoverClass::rock, 0.0, -0.4), rgb(0x475280));
}

TEST(Palette, BlendsByAltitude) {
  const Palette summer = read_palette("summer");
  const auto forest = [&](double altitude_m) {
    return palette_colour(summer, LandCoverClass::forest, altitude_m, 1.0);
  };
  expect_near(forest(200.0), rgb(0xa3a661));
  expect_near(forest(650.0), rgb(0xa3a661));
  expect_near(forest(900.0), 0.5F * (rgb(0xa3a661) + rgb(0x7d9a55)));
  expect_near(forest(1220.0), rgb(0x7d9a55));
  expect_near(forest(1525.0), 0.5F * (rgb(0x7d9a55) + rgb(0x6d8d63)));
  expect_near(forest(2600.0), rgb(0x6d8d63));
}

TEST(Palette, BuiltInPalettesAreCompleteAndGrowLighterWithTone) {
  for (const char* name :
       {"summer", "autumn", "winter", "desert", "high_desert", "steppe", "evening", "morning"}) {
    const Palette palette = read_palette(name);
    EXPECT_EQ(palette.name, name);
    EXPECT_EQ(palette.winter, std::string(name) == "winter");
    ASSERT_FALSE(palette.sky.empty());
    EXPECT_EQ(palette.sky.front().first, 0.0);
    EXPECT_EQ(palette.sky.back().first, 1.0);
    for (const LandCoverClassInfo& info : land_cover_classes()) {
      if (info.id == LandCoverClass::sky) continue;
      for (double altitude_m = 0.0; altitude_m < 3000.0; altitude_m += 300.0) {
        float darker = -1.0F;
        for (double tone = 0.0; tone <= 1.0; tone += 0.05) {
          const glm::vec3 c = palette_colour(palette, info.id, altitude_m, tone);
          const float luma = 0.2126F * c.r + 0.7152F * c.g + 0.0722F * c.b;
          EXPECT_GT(luma, darker) << name << " " << info.name << " tone " << tone;
          darker = luma;
        }
        // Shadows are blue-violet, never black; full light is warmer than shadow.
        const glm::vec3 shadow = palette_colour(palette, info.id, altitude_m, 0.0);
        const glm::vec3 light = palette_colour(palette, info.id, altitude_m, 1.0);
        EXPECT_GT(shadow.b, 0.3F) << info.name;
        EXPECT_GT(light.r - light.b, shadow.r - shadow.b) << info.name;
      }
    }
  }
}

// Glow at sunset and sunrise on high rock and snow, but not below and in the shade.
TEST(Palette, EveningAndMorningGlowOnHighGround) {
  for (const char* name : {"evening", "morning"}) {
    const Palette palette = read_palette(name);
    const auto warmth = [&](LandCoverClass id, double altitude_m, double tone) {
      const glm::vec3 c = palette_colour(palette, id, altitude_m, tone);
      return c.r - c.b;
    };
    for (const LandCoverClass id : {LandCoverClass::rock, LandCoverClass::snow}) {
      EXPECT_GT(warmth(id, 2900.0, 0.8), warmth(id, 1000.0, 0.8) + 0.04F) << name;
      EXPECT_GT(warmth(id, 2900.0, 0.8), 0.1F) << name;
      EXPECT_LT(warmth(id, 2900.0, 0.0), -0.2F) << name;
    }
    EXPECT_LT(warmth(LandCoverClass::valley_floor, 600.0, 0.0), -0.15F) << name;
    EXPECT_GT(palette.sky.back().second.r, palette.sky.back().second.b + 0.15F) << name;
    EXPECT_GT(palette.sky.front().second.b, palette.sky.front().second.r + 0.2F) << name;
  }
}

TEST(Palette, PaletteCanOverrideABuiltInOne) {
  const Palette desert = parse_palette(
      "based_on = \"summer\"\nname = \"desert\"\n[classes]\nrock = [\"#5a2a30\", \"#9a4a38\", "
      "\"#c87850\", \"#f0c8a0\"]\n",
      "desert.toml");
  EXPECT_EQ(desert.name, "desert");
  expect_near(palette_colour(desert, LandCoverClass::rock, 0.0, 0.34), rgb(0x9a4a38));
  const Palette summer = read_palette("summer");
  expect_near(palette_colour(desert, LandCoverClass::snow, 0.0, 0.7),
              palette_colour(summer, LandCoverClass::snow, 0.0, 0.7));
  EXPECT_EQ(desert.sky, summer.sky);
}

TEST(Palette, GrowthColoursAreReadAndInherited) {
  const Palette autumn = read_palette("autumn");
  EXPECT_GE(autumn.growth.leaves.size(), 3U);
  for (const glm::vec3& leaf : autumn.growth.leaves)
    EXPECT_GT(leaf.r, leaf.b + 0.2F) << "autumn's leaves are warm";
  const Palette mine = parse_palette(
      "based_on = \"autumn\"\n[growth]\nleaves = [\"#ff8000\"]\nleaf_share = 0.25\n", "mine.toml");
  ASSERT_EQ(mine.growth.leaves.size(), 1U);
  expect_near(mine.growth.leaves[0], rgb(0xff8000));
  EXPECT_EQ(mine.growth.leaf_share, 0.25);
  EXPECT_EQ(parse_palette("based_on = \"autumn\"\n", "mine.toml").growth.leaf_share,
            autumn.growth.leaf_share);
  EXPECT_THAT(error_of("based_on = \"summer\"\n[growth]\nleaf_share = 1.5\n"),
              HasSubstr("test.toml:3:14"));
  EXPECT_THAT(error_of("based_on = \"summer\"\n[growth]\nleafs = []\n"), HasSubstr("leaves"));
}

TEST(Palette, ReadsAFile) {
  const test::Folder folder;
  const std::string path =
      folder.write("frost.toml", "based_on = \"winter\"\n[strength]\nhaze = 0.5\n");
  const Palette palette = read_palette(path);
  EXPECT_TRUE(palette.winter);
  EXPECT_EQ(palette.haze_share, 0.5);
  std::remove(path.c_str());
  EXPECT_THROW(read_palette(path), Error);
  EXPECT_THROW(read_palette("spring"), Error);
}

TEST(Palette, ErrorsNamePlaceAndWhatIsAllowed) {
  const std::string head = "based_on = \"summer\"\n[classes]\n";
  EXPECT_THAT(error_of(head + "rock = [\"#5a2a30\", \"#9a4a38\", \"#c87850\"]\n"),
              HasSubstr("test.toml:3:8"));
  EXPECT_THAT(error_of(head + "rock = [\"#5a2a30\", \"#9a4a38\", \"#c87850\"]\n"),
              HasSubstr("four"));
  EXPECT_THAT(error_of(head + "rock = [\"#5a2a30\", \"#9a4a3\", \"#c87850\", \"#f0c8a0\"]\n"),
              HasSubstr("test.toml:3:20"));
  EXPECT_THAT(error_of(head + "rock = [\"#5a2a30\", \"#9a4a3g\", \"#c87850\", \"#f0c8a0\"]\n"),
              HasSubstr("#rrggbb"));
  EXPECT_THAT(error_of(head + "rok = []\n"), HasSubstr("rock"));
  EXPECT_THAT(error_of("based_on = \"sumer\"\n"), HasSubstr("summer"));
  EXPECT_THAT(error_of("based_on = \"summer\"\n[strength]\nhaze = 3\n"),
              HasSubstr("test.toml:3:8"));
  EXPECT_THAT(error_of("based_on = \"summer\"\n[sky]\ngradient = [{ at = 0.5, colour = \"#ffffff\" "
                       "}, { at = 0.4, colour = \"#ffffff\" }]\n"),
              HasSubstr("below the one before"));
  const std::string ramp = "[\"#000000\", \"#111111\", \"#222222\", \"#333333\"]";
  EXPECT_THAT(error_of(head + "rock = [{ altitude_m = 900, ramp = " + ramp +
                       " }, { altitude_m = 800, ramp = " + ramp + " }]\n"),
              HasSubstr("above the one before"));
  // Without a palette to build on, every class must be there.
  EXPECT_THAT(error_of("[classes]\nrock = " + ramp + "\n[sky]\ngradient = []\n[air]\n"),
              HasSubstr("shrub"));
  EXPECT_THAT(error_of("[sky]\n"), HasSubstr("classes"));
}

}  // namespace
}  // namespace belvedere
