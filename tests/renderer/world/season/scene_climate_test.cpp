#include "renderer/world/season/scene_climate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "terrain/io/crs.h"
#include "tests/files.h"
#include "tests/notes.h"

namespace belvedere {
namespace {

using test::Notes;
using testing::AllOf;
using testing::HasSubstr;

// A slope, 6 km square, 700 … 1900 m, in Tyrol.
Dem slope(const std::string& crs = "EPSG:32632") {
  Raster<float> raster{Grid<float>(200, 200),
                       {680000.0, 5240000.0, 30.0, 30.0},
                       crs.empty() ? crs : normalize_crs(crs)};
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) raster.cells(x, y) = 700.F + 6.0F * static_cast<float>(x);
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
  EXPECT_THAT(
      test::message_of(ErrorKind::usage, [&] { make_scene_climate(named, slope(), notes_); }),
      AllOf(HasSubstr("altitude_m"), HasSubstr("stations.csv")));
  EXPECT_THAT(
      test::message_of(ErrorKind::usage, [&] { make_scene_climate(scene(""), slope(""), notes_); }),
      HasSubstr("climate.latitude_deg"));
  EXPECT_NEAR(make_scene_climate(scene("[climate]\nlatitude_deg = 60\n"), slope(""), notes_)
                  .position.latitude_deg.at(5, 5),
              60.0, 1e-9);
  EXPECT_THAT(
      test::message_of(ErrorKind::usage, [&] { scene("[climate]\nwind_from_deg = 400\n"); }),
      HasSubstr("wind_from_deg"));
  EXPECT_THAT(
      test::message_of(ErrorKind::usage, [&] { scene("[climate]\nlapse_k_per_km = 20\n"); }),
      HasSubstr("K/km"));
}

}  // namespace
}  // namespace belvedere
