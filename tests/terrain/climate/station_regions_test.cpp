#include "terrain/climate/station_regions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace belvedere {
namespace {

// `count` stations on a line to the north, 100 m of altitude apart.
std::vector<Station> line_of(const std::string& region, double east_m, int count) {
  std::vector<Station> stations;
  for (int i = 0; i < count; ++i) {
    Station station;
    station.region = region;
    station.position = {east_m, 1000.0 * i};
    station.altitude_m = 500.0 + 100.0 * i;
    stations.push_back(station);
  }
  return stations;
}

std::vector<Station> joined(std::vector<Station> first, const std::vector<Station>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

bool is_known(const Station& station) { return !std::isnan(station.rain_mm); }

TEST(StationRegions, FewStationsShareThoseOfAll) {
  std::vector<Station> stations = joined(line_of("west", 0.0, 9), line_of("east", 60000.0, 9));
  std::vector<StationRegion> regions = station_regions(stations, is_known);
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0].name, "west");
  EXPECT_TRUE(regions[0].is_own && regions[1].is_own);
  EXPECT_EQ(regions[1].stations.size(), 9U);
  for (std::size_t i = 9; i < 11; ++i)
    stations[i].rain_mm = std::numeric_limits<double>::quiet_NaN();
  regions = station_regions(stations, is_known);
  EXPECT_TRUE(regions[0].is_own);
  EXPECT_FALSE(regions[1].is_own) << "seven with rain";
  EXPECT_EQ(regions[1].stations.size(), 16U);
  EXPECT_EQ(regions[1].at.size(), 9U) << "they still say where the region is";
  // A table without the column is one region, however few its stations.
  regions = station_regions(line_of("", 0.0, 3), is_known);
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_TRUE(regions[0].is_own);
  EXPECT_EQ(region_weights(regions, {5e5, 0.0}), std::vector<double>{1.0});
}

TEST(StationRegions, BlendBetweenTheirStations) {
  const std::vector<StationRegion> regions =
      station_regions(joined(line_of("west", 0.0, 9), line_of("east", 60000.0, 9)), is_known);
  double before = 1.0;
  for (int km = 0; km <= 60; ++km) {
    const std::vector<double> weights = region_weights(regions, {1000.0 * km, 4000.0});
    EXPECT_NEAR(weights[0] + weights[1], 1.0, 1e-12);
    EXPECT_LE(weights[0], before);
    EXPECT_LT(before - weights[0], 0.15) << "without a step, " << km << " km";
    if (km <= 19) {
      EXPECT_EQ(weights[0], 1.0) << km;
    }
    if (km >= 41) {
      EXPECT_EQ(weights[0], 0.0) << km;
    }
    before = weights[0];
  }
  EXPECT_NEAR(region_weights(regions, {30000.0, 4000.0})[0], 0.5, 1e-9);
}

}  // namespace
}  // namespace belvedere
