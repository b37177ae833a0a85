#include "renderer/world/season/scene_season.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "terrain/io/crs.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

Dem tyrol(const std::string& crs = "EPSG:32632") {
  Raster<float> raster{Grid<float>(100, 100),
                       {680000.0, 5240000.0, 90.0, 90.0},
                       crs.empty() ? crs : normalize_crs(crs)};
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) raster.cells(x, y) = 600.F + 22.F * static_cast<float>(x);
  return make_dem(std::move(raster));
}

class SceneSeasonTest : public testing::Test {
 protected:
  LoadedScene scene(const std::string& text) const {
    return parse_scene("version = 1\n" + text, "s.toml", folder_.path(), {});
  }
  test::Folder folder_;
};

TEST_F(SceneSeasonTest, DaysAreCountedFromTheFirstOfJanuary) {
  EXPECT_EQ(day_of_season({""}), std::nullopt);
  EXPECT_EQ(day_of_season({"01-01"}), 0);
  EXPECT_EQ(day_of_season({"02-29"}), day_of_season({"02-28"}));
  EXPECT_EQ(day_of_season({"03-01"}), 59);
  EXPECT_EQ(day_of_season({"12-31"}), 364);
  for (const char* wrong : {"2-30", "02-30", "13-01", "00-10", "1005", "10-5", "October 5"})
    EXPECT_THROW(scene("[season]\ndate = \"" + std::string(wrong) + "\"\n"), Error) << wrong;
}

// Means of a year around `mean`, warmest on day 200.
std::array<double, 365> year(double mean, double half_range) {
  std::array<double, 365> days{};
  for (std::size_t d = 0; d < days.size(); ++d)
    days[d] = mean + half_range * std::cos(2.0 * 3.14159265358979 *
                                           (static_cast<double>(d) - 200.0) / 365.0);
  return days;
}

TEST_F(SceneSeasonTest, AutumnComesWithTheColdAndGoesWithTheWinter) {
  const auto valley = year(9.0, 10.0);
  EXPECT_EQ(autumn_share(valley, 200), 0.0);
  EXPECT_LT(autumn_share(valley, 260), autumn_share(valley, 285));
  EXPECT_EQ(autumn_share(valley, 330), 1.0);
  EXPECT_EQ(autumn_share(valley, 120), 0.0) << "spring";
  EXPECT_EQ(autumn_share(valley, 40), 1.0) << "February: nothing grows yet";
  // Higher up it comes earlier; ground that is always cold does not turn in summer.
  EXPECT_GT(autumn_share(year(3.0, 9.0), 260), autumn_share(valley, 260));
  EXPECT_LT(autumn_share(year(-3.0, 8.0), 215), 0.1);
}

TEST_F(SceneSeasonTest, SummerTurnsFromTheHeightsDown) {
  const Palette summer = read_palette("summer");
  const Palette autumn = read_palette("autumn");
  const LoadedScene october =
      scene("[land_cover.settings]\ntreeline_m = 1820\n[season]\ndate = \"09-25\"\n");
  const Palette palette = palette_for_location(summer, october, tyrol());
  const auto turned = [&](double altitude_m) {
    const glm::vec3 a = palette_colour(summer, pasture, altitude_m, 0.5);
    const glm::vec3 b = palette_colour(autumn, pasture, altitude_m, 0.5);
    return (palette_colour(palette, pasture, altitude_m, 0.5).x - a.x) / (b.x - a.x);
  };
  EXPECT_LT(turned(700.0), 0.3F);
  EXPECT_GT(turned(2200.0), turned(1200.0));
  EXPECT_GT(turned(2200.0), 0.6F);
}

TEST_F(SceneSeasonTest, PalettesFollowTheTreelineOfThePlaceUnlessTheSceneHasItsOwn) {
  const Palette summer = read_palette("summer");
  const LoadedScene own = scene("[land_cover.settings]\ntreeline_m = 2400\n");
  EXPECT_EQ(palette_colour(palette_for_location(summer, own, tyrol()), forest, 1000.0, 0.5),
            palette_colour(summer, forest, 1000.0, 0.5));
  // Mexico, 19° N: forest up to about 3800 m, so that 1400 m lie far below the range of the
  // palette.
  const LoadedScene open = scene("");
  Dem mexico = tyrol("EPSG:32614");
  mexico.transform.origin_y = 2100000.0;
  const Palette there = palette_for_location(summer, open, mexico);
  EXPECT_EQ(palette_colour(there, forest, 1400.0, 0.5), palette_colour(summer, forest, 0.0, 0.5));
  EXPECT_NE(palette_colour(there, forest, 3000.0, 0.5),
            palette_colour(summer, forest, 3000.0, 0.5));
  // Terrain of unknown position, and a painter's own palette, are unchanged.
  EXPECT_EQ(palette_colour(palette_for_location(summer, open, tyrol("")), forest, 1000.0, 0.5),
            palette_colour(summer, forest, 1000.0, 0.5));
}

TEST_F(SceneSeasonTest, SummerIsOfOchreInDryCountry) {
  const Palette summer = read_palette("summer");
  const LoadedScene open = scene("[land_cover.settings]\ntreeline_m = 1820\n");
  // 90 m cells of the same ground near Leh, EPSG:32643.
  Dem leh = tyrol("EPSG:32643");
  leh.transform.origin_x = 740000.0;
  leh.transform.origin_y = 3782000.0;
  for (float& z : leh.altitude_m) z += 2800.F;
  const Palette dry = palette_for_location(summer, open, leh);
  const glm::vec3 ground = palette_colour(dry, alpine_grass, 3400.0, 0.7);
  const glm::vec3 desert = palette_colour(read_palette("high_desert"), alpine_grass, 3400.0, 0.7);
  EXPECT_LT(glm::length(ground - desert), 0.05F);
  // Not in Tyrol, and not in a palette that is named.
  EXPECT_EQ(palette_colour(palette_for_location(summer, open, tyrol()), alpine_grass, 2000.0, 0.7),
            palette_colour(summer, alpine_grass, 2000.0, 0.7));
  const LoadedScene evening = parse_scene("version = 1\npalette = \"evening\"\n", "s.toml", "", {});
  EXPECT_EQ(palette_colour(palette_for_location(read_palette("evening"), evening, leh), scree,
                           3400.0, 0.7),
            palette_colour(read_palette("evening"), scree, 3400.0, 0.7));
}

TEST_F(SceneSeasonTest, LakesFreezeWhereTheColdestMonthIsBelowThreeDegreesOfFrost) {
  PlaceClimate climate;
  climate.sea_level_c.fill(15.0);
  climate.sea_level_c[0] = 2.0;
  climate.lapse_k_per_km.fill(6.0);
  climate.lapse_k_per_km[0] = 4.0;
  EXPECT_NEAR(lakes_freeze_from_m(climate), 1250.0, 1e-9);
  climate.sea_level_c[0] = -3.5;
  EXPECT_EQ(lakes_freeze_from_m(climate), -std::numeric_limits<double>::infinity());
  climate.sea_level_c[0] = 2.0;
  climate.lapse_k_per_km[0] = 0.0;
  EXPECT_EQ(lakes_freeze_from_m(climate), std::numeric_limits<double>::infinity());
}

TEST_F(SceneSeasonTest, WinterHasIceByTheClimateUnlessTheSceneSaysOtherwise) {
  const auto from_m = [&](const std::string& palette, const std::string& asked,
                          const std::string& crs = "EPSG:32632") {
    return palette_for_location(read_palette(palette),
                                scene("[season]\nfrozen_lakes = \"" + asked + "\"\n"), tyrol(crs))
        .lakes_freeze_from_m;
  };
  // The lakes of Tyrol at 930 m are frozen, those of the plain, some 550 m high, mostly are not.
  EXPECT_GT(from_m("winter", "auto"), 300.0);
  EXPECT_LT(from_m("winter", "auto"), 1200.0);
  EXPECT_EQ(from_m("winter", "always"), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(from_m("winter", "never"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(from_m("summer", "always"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(from_m("winter", "auto", ""), std::numeric_limits<double>::infinity())
      << "a place that is not known";
}

}  // namespace
}  // namespace belvedere
