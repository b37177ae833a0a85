#include "terrain/climate/map_climate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "terrain/climate/default_climate.h"
#include "terrain/climate/water_balance.h"
#include "terrain/climate/zonal_climate.h"
#include "terrain/io/crs.h"

namespace belvedere {
namespace {

// Ground in Tyrol from a formula of metres east and north of the north-western corner.
Dem ground(int width, int height, double cell_m,
           const std::function<double(double, double)>& altitude) {
  Raster<float> raster{Grid<float>(width, height),
                       {680000.0, 5240000.0, cell_m, cell_m},
                       normalize_crs("EPSG:32632")};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      raster.cells(x, y) = static_cast<float>(altitude(x * cell_m, -y * cell_m));
  return make_dem(std::move(raster));
}

Climate climate_of(const Dem& dem) {
  return make_climate(
      dem, {}, [](glm::dvec2 lonlat) { return default_climate(lonlat.x, lonlat.y); },
      silent_progress());
}

MapPosition position_of(const Dem& dem) {
  return make_map_position(dem.transform, dem.crs, dem.width(), dem.height(), {});
}

TEST(MapClimate, OneCellAcrossHasTheLinesOfItsPlace) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {9, 1}}) {
    const Dem dem = ground(width, height, 90.0, [](double, double) { return 600.0; });
    const Climate climate = climate_of(dem);
    const RuleClimate rules = make_map_climate(dem, climate, {});
    const std::vector<float> altitude(9, 1000.F);
    for (const ClimateVariable variable : {ClimateVariable::treeline, ClimateVariable::moisture}) {
      std::vector<float> row(9);
      fill_climate_row(rules, variable, dem.transform, height - 1, width, altitude.data(),
                       row.data());
      const PlaceClimate last = climate.at(width - 1.0, height - 1.0);
      EXPECT_NEAR(row[static_cast<std::size_t>(width) - 1],
                  variable == ClimateVariable::treeline ? treeline_m(last)
                                                        : plant_water_share(last, 1000.0),
                  0.05)
          << width << " x " << height;
    }
  }
}

TEST(MapClimate, PostsHoldTheLinesOfTheirPlaces) {
  const Dem dem = ground(400, 300, 90.0, [](double e, double) { return 600.0 + 0.02 * e; });
  const Climate climate = climate_of(dem);
  const RuleClimate rules = make_map_climate(dem, climate, {.day_of_season = 20});
  const PlaceClimate corner = climate.at(0.0, 0.0);
  EXPECT_NEAR(rules.treeline_m(0, 0), treeline_m(corner), 0.05);
  EXPECT_NEAR(rules.ice_line_m(0, 0), snow_line_m(corner), 0.05);
  EXPECT_GT(rules.snow_line_m(0, 0), rules.ice_line_m(0, 0)) << "open ground gathers less snow";
  EXPECT_NEAR(rules.season_snow_m(0, 0), snow_line_of_day_m(corner, 20), 0.05);
  EXPECT_LT(rules.season_snow_m(0, 0), 1500.F) << "in January";
  EXPECT_EQ(make_map_climate(dem, climate, {}).season_snow_m(0, 0), no_season_snow_m);
  // The last post stands on the last cell.
  std::vector<float> altitude(400, 1000.F);
  std::vector<float> row(400);
  fill_climate_row(rules, ClimateVariable::treeline, dem.transform, 299, 400, altitude.data(),
                   row.data());
  EXPECT_NEAR(row[399], treeline_m(climate.at(399.0, 299.0)), 0.05);
  fill_climate_row(rules, ClimateVariable::moisture, dem.transform, 0, 400, altitude.data(),
                   row.data());
  EXPECT_NEAR(row[0], plant_water_share(corner, 1000.0), 0.01);
}

// Between posts and altitudes values are linear: their maximum error against the climate itself,
// over 90 km of the default climate with wind, at all altitudes of maps there.
TEST(MapClimate, TablesStayCloseToTheClimateBetweenTheirPosts) {
  const Dem dem = ground(600, 500, 150.0, [](double e, double n) {
    return 1500.0 + 900.0 * std::sin(e / 9000.0) * std::cos(n / 7000.0) +
           300.0 * std::sin(e / 2500.0);
  });
  const Climate climate = climate_of(dem);
  const RuleClimate rules = make_map_climate(dem, climate, {});
  double worst_c = 0.0;
  double worst_moisture = 0.0;
  double worst_rain = 0.0;
  double square_moisture = 0.0;
  double worst_line_m = 0.0;
  int count = 0;
  std::vector<float> altitude(600);
  std::vector<float> row(600);
  for (int y = 3; y < 500; y += 31)
    for (const float z : {300.F, 733.F, 1250.F, 1790.F, 2240.F, 3111.F}) {
      std::fill(altitude.begin(), altitude.end(), z);
      const auto value = [&](ClimateVariable variable) -> const std::vector<float>& {
        fill_climate_row(rules, variable, dem.transform, y, 600, altitude.data(), row.data());
        return row;
      };
      const std::vector<float> temperature = value(ClimateVariable::temperature);
      const std::vector<float> moisture = value(ClimateVariable::moisture);
      const std::vector<float> rain = value(ClimateVariable::rain);
      const std::vector<float> treeline = value(ClimateVariable::treeline);
      for (int x = 5; x < 600; x += 41) {
        const auto at = static_cast<std::size_t>(x);
        const PlaceClimate here = climate.at(x, y);
        double year_c = 0.0;
        for (const double month_c : monthly_c(here, static_cast<double>(z)))
          year_c += month_c / 12.0;
        worst_c = std::max(worst_c, std::abs(static_cast<double>(temperature[at]) - year_c));
        const double miss = std::abs(static_cast<double>(moisture[at]) -
                                     plant_water_share(here, static_cast<double>(z)));
        worst_moisture = std::max(worst_moisture, miss);
        square_moisture += miss * miss;
        worst_rain = std::max(
            worst_rain,
            std::abs(static_cast<double>(rain[at]) / rain_mm(here, static_cast<double>(z)) - 1.0));
        worst_line_m =
            std::max(worst_line_m, std::abs(static_cast<double>(treeline[at]) - treeline_m(here)));
        ++count;
      }
    }
  RecordProperty("c", std::to_string(worst_c));
  RecordProperty("moisture", std::to_string(worst_moisture));
  RecordProperty("moisture_rms", std::to_string(std::sqrt(square_moisture / count)));
  RecordProperty("rain", std::to_string(worst_rain));
  RecordProperty("line_m", std::to_string(worst_line_m));
  EXPECT_LT(worst_c, 1e-4);
  EXPECT_LT(worst_moisture, 0.055) << "between 500 m of altitude, where the soil begins to dry";
  EXPECT_LT(std::sqrt(square_moisture / count), 0.01);
  EXPECT_LT(worst_rain, 0.035);
  EXPECT_LT(worst_line_m, 0.2);
}

TEST(MapClimate, LevelGroundGetsLevelGroundsSunAtAnyAltitude) {
  const ThreadLimit one(1);  // so little ground is no work for two
  for (const double altitude : {0.0, 3000.0}) {
    const Dem dem = ground(20, 20, 100.0, [&](double, double) { return altitude; });
    const Grid<float> share = sun_share(dem, position_of(dem), {});
    EXPECT_NEAR(share(10, 10), 1.F, 2e-3F) << altitude;
  }
  // Also next to ground of other altitudes that casts no shadow: a very gentle ramp.
  const Dem ramp = ground(200, 20, 100.0, [](double e, double) { return 0.1 * e; });
  EXPECT_NEAR(sun_share(ramp, position_of(ramp), {})(150, 10), 1.F, 0.03F);
}

TEST(MapClimate, SunnySlopesGetMoreAndShadedOnesLess) {
  const ThreadLimit one(1);  // so little ground is no work for two
  const Dem south = ground(30, 30, 100.0, [](double, double n) { return 3400.0 + 0.4 * n; });
  const Dem north = ground(30, 30, 100.0, [](double, double n) { return 1600.0 - 0.4 * n; });
  EXPECT_GT(sun_share(south, position_of(south), {})(15, 15), 1.15F);
  EXPECT_LT(sun_share(north, position_of(north), {})(15, 15), 0.7F);
}

TEST(MapClimate, IsTheSameForAnyThreads) {
  const Dem dem = ground(150, 100, 50.0, [](double e, double n) {
    return 1500.0 + 700.0 * std::sin(e / 900.0) * std::cos(n / 700.0);
  });
  const auto make = [&](int threads) {
    const ThreadLimit limit(threads);
    RuleClimate climate = make_map_climate(dem, climate_of(dem), {});
    climate.sun = sun_share(dem, position_of(dem), {});
    return climate;
  };
  const RuleClimate one = make(1);
  const RuleClimate two = make(2);
  EXPECT_EQ(one.sun, two.sun);
  EXPECT_EQ(one.treeline_m, two.treeline_m);
  EXPECT_EQ(one.moisture, two.moisture);
}

TEST(MapClimate, AWindowHasTheSunThatTheWholeGivesIt) {
  // A range in the south, 2500 m above a plain with small hills, entirely outside the window.
  const auto altitude = [](double e, double n) {
    return 600.0 + 2500.0 * std::exp(-std::pow((n + 21000.0) / 1500.0, 2.0)) +
           40.0 * std::sin(e / 900.0) * std::cos(n / 700.0);
  };
  const Dem whole = ground(300, 300, 90.0, altitude);
  const Grid<float> of_whole = sun_share(whole, position_of(whole), {});
  Dem window = whole;
  window.altitude_m = Grid<float>(90, 80);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 90; ++x) window.altitude_m(x, y) = whole.altitude_m(100 + x, 120 + y);
  window.transform.origin_x += 100 * 90.0;
  window.transform.origin_y -= 120 * 90.0;
  const Grid<float> share = sun_share(window, whole, {}, {});
  const Grid<float> alone = sun_share(window, position_of(window), {});
  ASSERT_TRUE(share.same_size(window.altitude_m));
  float apart = 0.F;
  float apart_alone = 0.F;
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 90; ++x) {
      apart = std::max(apart, std::abs(share(x, y) - of_whole(100 + x, 120 + y)));
      apart_alone = std::max(apart_alone, std::abs(alone(x, y) - of_whole(100 + x, 120 + y)));
    }
  EXPECT_LT(apart, 0.004F);
  EXPECT_GT(apart_alone, 0.02F) << "the range throws shadows into it";
}

}  // namespace
}  // namespace belvedere
