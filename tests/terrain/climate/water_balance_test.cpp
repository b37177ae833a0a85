#include "terrain/climate/water_balance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "terrain/climate/default_climate.h"
#include "tests/terrain/climate/synthetic_months.h"

namespace belvedere {
namespace {

// The same all the year and at every altitude.
PlaceClimate even(double mean_c, double rain_mm) {
  PlaceClimate climate;
  climate.sea_level_c.fill(mean_c);
  climate.lapse_k_per_km.fill(0.0);
  climate.rain_mm_at_km.fill(rain_mm);
  return climate;
}

TEST(WaterBalance, EvenRainIsSharedAsItFalls) {
  // The potential evapotranspiration at 10 °C is 650 mm.
  EXPECT_NEAR(plant_water_share(even(10.0, 325.0), 0.0), 0.5, 1e-9);
  EXPECT_NEAR(plant_water_share(even(10.0, 650.0), 0.0), 1.0, 1e-9);
  EXPECT_NEAR(plant_water_share(even(10.0, 2000.0), 0.0), 1.0, 1e-9);
  EXPECT_NEAR(plant_water_share(even(20.0, 325.0), 0.0), 0.25, 1e-9);
  EXPECT_NEAR(plant_water_share(even(10.0, 0.0), 0.0), 0.0, 1e-9);
}

TEST(WaterBalance, WhereNothingGrowsNothingLacks) {
  EXPECT_EQ(plant_water_share(even(-3.0, 0.0), 0.0), 1.0);
}

TEST(WaterBalance, WinterRainServesSummerOnlyAsFarAsTheSoilHoldsIt) {
  PlaceClimate summer_rain = even(10.0, 600.0);
  for (std::size_t m = 3; m < 9; ++m) summer_rain.sea_level_c[m] = 20.0;
  PlaceClimate winter_rain = summer_rain;
  summer_rain.summer_share = 0.8;
  winter_rain.summer_share = 0.1;
  EXPECT_GT(plant_water_share(summer_rain, 0.0), plant_water_share(winter_rain, 0.0) + 0.04);
  // A deeper soil carries more of it into the summer.
  EXPECT_GT(plant_water_share(winter_rain, 0.0, {.soil_mm = 300.0}),
            plant_water_share(winter_rain, 0.0) + 0.04);
}

TEST(WaterBalance, SnowWaitsForTheThaw) {
  PlaceClimate cold = even(8.0, 300.0);
  for (const std::size_t m : {0U, 1U, 2U, 9U, 10U, 11U}) cold.sea_level_c[m] = -8.0;
  cold.summer_share = 0.0;  // as much in winter as there can be: 247 of the 300 mm
  // Demand is 260 mm; of the snow that melts in April the soil keeps 120 mm besides April's demand,
  // and the rain of May to September adds to it.
  const Months falls = monthly_rain_mm(cold, 0.0);
  const double later_mm = std::accumulate(falls.begin() + 4, falls.begin() + 9, 0.0);
  const double april_mm = 8.0 * 65.0 / 12.0;
  EXPECT_NEAR(plant_water_share(cold, 0.0), (april_mm + 120.0 + later_mm) / (6.0 * april_mm), 1e-6);
}

TEST(WaterBalance, DryAirTakesMoreAndSomeOfTheSnow) {
  PlaceClimate dry = even(7.0, 455.0);
  EXPECT_NEAR(plant_water_share(dry, 0.0), 1.0, 1e-9);
  dry.dry_air = 1.0;  // 65 mm · (7 + 10)
  EXPECT_NEAR(plant_water_demand_mm(dry, 0.0), 1105.0, 1e-9);
  EXPECT_NEAR(plant_water_share(dry, 0.0), 455.0 / 1105.0, 1e-9);
  PlaceClimate snowy = even(8.0, 240.0);
  for (const std::size_t m : {0U, 1U, 2U, 9U, 10U, 11U}) snowy.sea_level_c[m] = -8.0;
  snowy.dry_air = 1.0;  // all of the 20 mm that fall in a month
  const double demand_mm = 6.0 * (8.0 + 11.0) * 65.0 / 12.0;
  EXPECT_NEAR(plant_water_share(snowy, 0.0), 120.0 / demand_mm, 1e-9);
}

TEST(WaterBalance, HigherUpIsWetter) {
  const double low = plant_water_share(default_climate(-113.0, 37.3), 800.0);
  const double high = plant_water_share(default_climate(-113.0, 37.3), 2800.0);
  EXPECT_LT(low, 0.4);   // St. George, Utah: desert
  EXPECT_GT(high, 0.8);  // forest on the plateau
}

TEST(WaterBalance, KnowsWoodsFromSteppesAndDeserts) {
  const auto at = [](double longitude, double latitude, double altitude_m) {
    return plant_water_share(default_climate(longitude, latitude), altitude_m);
  };
  // The rules have closed forest from .72 on, bare ground from .26 down.
  EXPECT_GT(at(8.6, 47.4, 600.0), 0.9);       // Zürich
  EXPECT_GT(at(-60.0, -3.1, 70.0), 0.72);     // Manaus
  EXPECT_GT(at(-122.3, 47.5, 800.0), 0.72);   // Cascades above Seattle
  EXPECT_LT(at(-104.9, 39.8, 1600.0), 0.72);  // Denver
  EXPECT_LT(at(32.9, 40.0, 900.0), 0.72);     // Ankara
  EXPECT_LT(at(31.4, 30.1, 80.0), 0.1);       // Cairo
}

using test::seasons;

constexpr int february = 45;
constexpr int may = 135;
constexpr int august = 230;

PlaceClimate position_of(double mean, double swing, double rain) {
  PlaceClimate position;
  position.sea_level_c = seasons(mean, swing);
  position.lapse_k_per_km.fill(6.0);
  position.rain_mm_at_km.fill(rain);
  return position;
}

TEST(SnowToLast, IsOhmurasParabola) {
  // Three months about the top: the mean cosine of -30°, 0°, 30°.
  const double top = (1.0 + std::sqrt(3.0)) / 3.0;
  const double swing = 10.0 / top;
  EXPECT_NEAR(snow_to_last_mm(seasons(-10.0, swing)), 645.0, 1e-6);
  EXPECT_NEAR(snow_to_last_mm(seasons(-7.0, swing)), 645.0 + 296.0 * 3.0 + 9.0 * 9.0, 1e-6);
  EXPECT_NEAR(snow_to_last_mm(seasons(-13.0, swing)), 645.0 - 296.0 * 3.0 + 9.0 * 9.0, 1e-6);
  EXPECT_NEAR(snow_to_last_mm(seasons(-60.0, swing)), snow_to_last_mm(seasons(-40.0, swing)), 1e-6);
}

TEST(SnowToLast, SummersThatNeverEndCountFourTimes) {
  EXPECT_NEAR(snow_to_last_mm(seasons(1.0, 0.0)), 645.0 + 4.0 * 305.0, 1e-9);
  EXPECT_NEAR(snow_to_last_mm(seasons(-1.0, 0.0)), 645.0 - 287.0, 1e-9);
}

TEST(SnowBalance, SnowLineIsWhereItIsNone) {
  const PlaceClimate position = position_of(8.0, 9.0, 1500.0);
  const double line = snow_line_m(position);
  EXPECT_NEAR(snow_balance_mm(position, line), 0.0, 0.01);
  EXPECT_GT(snow_balance_mm(position, line + 100.0), 0.0);
  // Lines are higher with less accumulation, and with warmth, by 1000 / 6 m per kelvin.
  EXPECT_GT(snow_line_m(position, {1.0, 0.0}), line + 50.0);
  EXPECT_NEAR(snow_line_m(position, {2.0, 1.0}) - line, 1000.0 / 6.0, 0.1);
}

TEST(SnowBalance, WhereHollowsGatherMoreSnowLastsLower) {
  PlaceClimate position = position_of(8.0, 9.0, 1500.0);
  const double usual = snow_line_m(position);
  position.gathers = 0.65;
  EXPECT_NEAR(snow_line_m(position), snow_line_m(position_of(8.0, 9.0, 1500.0), {2.0 * 0.65, 0.0}),
              0.01);
  EXPECT_GT(snow_line_m(position), usual + 50.0);
}

TEST(SnowBalance, RainIsNoSnow) {
  const PlaceClimate position = position_of(15.0, 8.0, 1200.0);
  double low = 0.0;
  double high = 0.0;
  for (const double mm : monthly_snow_mm(position, 0.0)) low += mm;
  for (const double mm : monthly_snow_mm(position, 5000.0)) high += mm;
  EXPECT_EQ(low, 0.0);
  EXPECT_NEAR(high, 1200.0, 1e-9);
}

TEST(SnowCover, LinesRiseFromWinterToSummer) {
  const PlaceClimate alps = default_climate(11.0, 47.0);
  const double winter = snow_line_of_day_m(alps, february);
  const double spring = snow_line_of_day_m(alps, may);
  const double summer = snow_line_of_day_m(alps, august);
  EXPECT_LT(winter, 1000.0);
  EXPECT_GT(spring, 1500.0);
  EXPECT_LT(spring, 2500.0);
  EXPECT_GT(summer, 2600.0);
  EXPECT_LT(summer, 3800.0);
}

TEST(SnowCover, SeasonsAreOfTheirHemisphere) {
  const PlaceClimate new_zealand = default_climate(170.0, -44.0);
  EXPECT_GT(snow_line_of_day_m(new_zealand, february),
            snow_line_of_day_m(new_zealand, 250) + 500.0);
  EXPECT_EQ(snow_cover_mm(default_climate(25.0, 25.0), 500.0, february), 0.0);
}

TEST(SnowCover, OfAColdYearIsWhatFell) {
  // Without thaw, all snow since thirty days after the warmest (15 July) remains, a millimetre per
  // day.
  const PlaceClimate position = position_of(-30.0, 10.0, 365.0);
  EXPECT_NEAR(snow_cover_mm(position, 0.0, 200), 200.0 - (195.0 + 30.0) + 365.0, 2.0);
  EXPECT_NEAR(snow_cover_mm(position, 0.0, 364) - snow_cover_mm(position, 0.0, 354), 10.0, 1e-6);
}

TEST(SnowCover, MeltsByTheDegreeDay) {
  // Constant warmth melts more than falls: no snow; at half the melt a part of the snowfall
  // remains.
  const PlaceClimate position = position_of(2.0, 0.0, 3650.0);
  // 10 mm a day, a quarter of it snow, 4.5 mm/K/d over (2 + 4)² / 16 K.
  EXPECT_EQ(snow_cover_mm(position, 0.0, 100), 0.0);
  MeltParameters slow;
  slow.melt_mm_per_k_day = 1.0;
  const double a = snow_cover_mm(position, 0.0, 100, {1.0, 0.0}, slow);
  const double b = snow_cover_mm(position, 0.0, 110, {1.0, 0.0}, slow);
  EXPECT_NEAR(b - a, 10.0 * (10.0 * 0.25 - 2.25), 1e-6);
}

}  // namespace

}  // namespace belvedere
