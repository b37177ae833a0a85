#include "terrain/climate/dry_places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "terrain/climate/default_climate.h"
#include "terrain/climate/water_balance.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

// 800 mm everywhere, 10 °C at 0 m.
PlaceClimate mild() {
  PlaceClimate climate;
  climate.sea_level_c.fill(10.0);
  climate.lapse_k_per_km.fill(5.0);
  climate.rain_mm_at_km.fill(800.0);
  return climate;
}

DryPlace basin(double longitude_deg) {
  return {.name = "B",
          .latitude_deg = 0.0,
          .longitude_deg = longitude_deg,
          .radius_km = 100.0,
          .floor_m = 1000.0,
          .wet_from_m = 3000.0,
          .rain_mm = 200.0,
          .evaporation_mm = 900.0};
}

TEST(DryPlaces, TheFloorHasItsRainAndEvaporationAndTheCrestsKeepTheirRain) {
  const PlaceClimate dried = dried_climate(make_dry_country({basin(10.0)}), mild(), 10.2, 0.1);
  EXPECT_NEAR(rain_mm(dried, 0.0), 200.0, 1e-9);
  EXPECT_NEAR(rain_mm(dried, 1000.0), 200.0, 1e-9);
  EXPECT_NEAR(rain_mm(dried, 2000.0), 400.0, 1e-9);  // half of the logarithm
  EXPECT_EQ(rain_mm(dried, 3000.0), 800.0);
  EXPECT_NEAR(plant_water_demand_mm(dried, 1000.0), 900.0, 1e-9);
  EXPECT_NEAR(plant_water_share(dried, 1000.0), 200.0 / 900.0, 1e-9);
}

TEST(DryPlaces, BeyondTheRadiusNothingChanges) {
  const DryCountry country = make_dry_country({basin(10.0)});
  const PlaceClimate beyond = dried_climate(country, mild(), 10.91, 0.0);
  EXPECT_EQ(beyond.rain_mm_at_km, mild().rain_mm_at_km);
  EXPECT_EQ(beyond.dry_air, 0.0);
  EXPECT_EQ(beyond.sheltered, 0.0);
  EXPECT_EQ(dried_climate(country, mild(), 10.2, 0.0).sheltered, 1.0);
  const PlaceClimate near = dried_climate(country, mild(), 10.8, 0.0);
  EXPECT_LT(near.rain_mm_at_km[0], 800.0);
  EXPECT_GT(near.rain_mm_at_km[0], 600.0);
}

TEST(DryPlaces, WhereTwoOverlapTheirMeanHolds) {
  DryPlace drier = basin(10.0);
  drier.rain_mm = 50.0;
  const PlaceClimate both =
      dried_climate(make_dry_country({basin(10.0), drier}), mild(), 10.0, 0.0);
  EXPECT_NEAR(rain_mm(both, 500.0), 100.0, 1e-9);  // the geometric mean
  EXPECT_NEAR(plant_water_demand_mm(both, 1000.0), 900.0, 1e-9);
}

TEST(DryPlaces, NeverMakeAPlaceWetter) {
  DryPlace wet = basin(10.0);
  wet.rain_mm = 600.0;
  PlaceClimate desert = mild();
  desert.rain_mm_at_km.fill(100.0);
  const PlaceClimate dried = dried_climate(make_dry_country({wet}), desert, 10.0, 0.0);
  EXPECT_EQ(dried.rain_mm_at_km, desert.rain_mm_at_km);
}

TEST(DryPlaces, TheWetSidesOfRangesAreBeyondAllOfThem) {
  const std::vector<std::pair<double, double>> places = {
      {11.4, 47.3},   {7.9, 46.3},    {6.6, 44.9},    {11.9, 46.4},   {7.4, 43.9},    {15.5, 47.5},
      {138.7, 35.4},  {83.9, 28.5},   {84.5, 28.6},   {85.5, 28.3},   {86.9, 28.1},   {81.5, 29.2},
      {170.1, -43.6}, {168.7, -45.0}, {169.4, -45.2}, {175.6, -39.3}, {-121.8, 46.9}, {7.0, 61.5}};
  for (const auto& [longitude, latitude] : places)
    EXPECT_EQ(default_climate(longitude, latitude).dry_air, 0.0) << longitude << ' ' << latitude;
}

TEST(DryPlaces, TheBuiltInOnesAreDry) {
  const std::vector<DryPlace> places = read_dry_places();
  EXPECT_GT(places.size(), 100U);
  for (const DryPlace& place : places) {
    EXPECT_LT(place.rain_mm / place.evaporation_mm, 0.5) << place.name;  // UNEP: semi-arid
    EXPECT_GT(default_climate(place.longitude_deg, place.latitude_deg).dry_air, 0.04) << place.name;
  }
}

TEST(DryPlaces, BadRowsNameTheirLine) {
  const auto message_of = [](const std::string& text) {
    return test::message_of(ErrorKind::usage, [&] { dry_places_from_toml(text, "d.toml"); });
  };
  EXPECT_THAT(message_of("version = 1\nplaces = [\n[\"A\", 45.0, 0]]"), HasSubstr("d.toml:3"));
  EXPECT_THAT(
      message_of("version = 1\nplaces = [\n[\"A\", 45.0, 0, 100, 900, 800, 100, 1000, \"X\"]]"),
      HasSubstr("d.toml:3"));  // wet below its floor
  EXPECT_THAT(message_of("version = 2\nplaces = []"), HasSubstr("version = 1"));
}

}  // namespace
}  // namespace belvedere
