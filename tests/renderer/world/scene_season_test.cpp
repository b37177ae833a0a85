#include "renderer/world/scene_season.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "terrain/io/crs.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/notes.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

Dem tyrol(const std::string& crs = "EPSG:32632") {
  Raster<float> raster{Grid<float>(100, 100),
                       {680000.0, 5240000.0, 90.0, 90.0},
                       crs.empty() ? crs : normalize_crs(crs)};
  for (const auto [x, y] : test::cells(100, 100))
    raster.cells(x, y) = 600.F + 22.F * static_cast<float>(x);
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

using test::Notes;
using testing::AllOf;
using testing::HasSubstr;

// A slope, 6 km square, 700 … 1900 m, in Tyrol.
Dem slope(const std::string& crs = "EPSG:32632") {
  Raster<float> raster{Grid<float>(200, 200),
                       {680000.0, 5240000.0, 30.0, 30.0},
                       crs.empty() ? crs : normalize_crs(crs)};
  for (const auto [x, y] : test::cells(200, 200))
    raster.cells(x, y) = 700.F + 6.0F * static_cast<float>(x);
  return make_dem(std::move(raster));
}

class SceneClimateTest : public testing::Test {
 protected:
  LoadedScene scene(const std::string& text) const {
    return parse_scene("version = 1\n" + text, "s.toml", folder_.path(), {});
  }
  test::Folder folder_;
  Notes notes_;
};

TEST_F(SceneClimateTest, IsThatOfThePlaceWhereNothingIsSaid) {
  const LoadedScene bare = scene("");
  EXPECT_FALSE(names_climate(bare.scene));
  const PlaceClimate column = make_scene_climate(bare, slope(), notes_).at(100, 100);
  EXPECT_NEAR(monthly_c(column, 580.0)[6], 18.0, 2.5);  // Innsbruck
  EXPECT_GT(monthly_c(column, 500.0)[6], monthly_c(column, 500.0)[0] + 10.0);
  EXPECT_THAT(notes_.text(), HasSubstr("from latitude, longitude and altitude only"));
}

TEST_F(SceneClimateTest, StationsBesideTheSceneAreUsedAndSayHowSureTheyAre) {
  std::string text = "name,lon,lat,altitude_m,t_year,rain_mm\n";
  for (int i = 0; i < 10; ++i)
    text += "S,11.4,47." + std::to_string(20 + i) + "," + std::to_string(500 + 200 * i) + "," +
            std::to_string(10.0 - 1.2 * i) + "," + std::to_string(800 + 20 * i) + "\n";
  folder_.write("stations.csv", text);
  const LoadedScene named = scene("[climate]\nstations = \"stations.csv\"\nwind_from_deg = 200\n");
  EXPECT_TRUE(names_climate(named.scene));
  const Climate climate = make_scene_climate(named, slope(), notes_);
  double year = 0.0;
  for (const double month : climate.at(10, 10).lapse_k_per_km) year += month / 12.0;
  EXPECT_NEAR(year, 6.0, 1e-6);
  EXPECT_EQ(climate.wind_from_deg, 200.0);
  EXPECT_THAT(notes_.text(), AllOf(HasSubstr("falls 6.00 K/km"),
                                   HasSubstr("95 % of resampled stations: 6.00 … 6.00"),
                                   HasSubstr("wind from 200°")));
}

TEST_F(SceneClimateTest, AFactorMakesItDrierOrWetter) {
  const PlaceClimate usual = make_scene_climate(scene(""), slope(), notes_).at(100, 100);
  const PlaceClimate half =
      make_scene_climate(scene("[climate]\nrain_factor = 0.5\n"), slope(), notes_).at(100, 100);
  EXPECT_NEAR(rain_mm(half, 900.0), 0.5 * rain_mm(usual, 900.0), 1e-9);
  EXPECT_THAT(notes_.text(), HasSubstr("times 0.5, set by the scene"));
}

TEST_F(SceneClimateTest, WhatIsMissingIsNamed) {
  folder_.write("stations.csv", "lon,lat,t_year\n11,47,5\n");
  const LoadedScene named = scene("[climate]\nstations = \"stations.csv\"\n");
  EXPECT_THAT(test::usage_error([&] { make_scene_climate(named, slope(), notes_); }),
              AllOf(HasSubstr("altitude_m"), HasSubstr("stations.csv")));
  EXPECT_THAT(test::usage_error([&] { make_scene_climate(scene(""), slope(""), notes_); }),
              HasSubstr("climate.latitude_deg"));
  EXPECT_NEAR(make_scene_climate(scene("[climate]\nlatitude_deg = 60\n"), slope(""), notes_)
                  .position.latitude_deg.at(5, 5),
              60.0, 1e-9);
  EXPECT_THAT(test::usage_error([&] { scene("[climate]\nwind_from_deg = 400\n"); }),
              HasSubstr("wind_from_deg"));
  EXPECT_THAT(test::usage_error([&] { scene("[climate]\nlapse_k_per_km = 20\n"); }),
              HasSubstr("K/km"));
}

}  // namespace
}  // namespace belvedere
