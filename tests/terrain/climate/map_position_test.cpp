#include "terrain/climate/map_position.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "terrain/io/crs.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

TEST(MapPosition, KnowsLatitudeAndTrueNorthOfEachCell) {
  // UTM 32: columns run north on its meridian, 9° E; 2° from it they are rotated by 2° · sin φ.
  const std::string utm = normalize_crs("EPSG:32632");
  const GeoTransform transform{
      .origin_x = 600000.0, .origin_y = 5300000.0, .cell_x = 100.0, .cell_y = 100.0};
  const MapPosition position = make_map_position(transform, utm, 800, 600, {});
  for (const glm::dvec2 cell :
       {glm::dvec2{0.0, 0.0}, glm::dvec2{799.0, 599.0}, glm::dvec2{400.0, 300.0}}) {
    const glm::dvec2 at = transform.to_crs(cell.x, cell.y);
    const glm::dvec2 lonlat = transform_point(utm, normalize_crs("EPSG:4326"), at);
    EXPECT_NEAR(position.latitude_deg.at(cell.x, cell.y), lonlat.y, 0.01);
    EXPECT_NEAR(position.longitude_deg.at(cell.x, cell.y), lonlat.x, 0.02);
    EXPECT_NEAR(position.grid_north_deg.at(cell.x, cell.y), (lonlat.x - 9.0) * 0.735, 0.02);
  }
  EXPECT_NEAR(position.centre_lonlat_deg().y, 47.4, 0.3);
  EXPECT_EQ(position.cell_m, glm::dvec2(100.0, 100.0));
}

TEST(MapPosition, DegreesRunNorthAndHaveTheirLengthOnTheGround) {
  const MapPosition position =
      make_map_position({.origin_x = 10.0, .origin_y = 61.0, .cell_x = 0.01, .cell_y = 0.01},
                        normalize_crs("EPSG:4326"), 200, 200, {});
  EXPECT_NEAR(position.latitude_deg.at(0, 0), 60.995, 1e-6);
  EXPECT_NEAR(position.latitude_deg.at(0, 199), 59.005, 1e-6);
  EXPECT_NEAR(position.grid_north_deg.at(100, 100), 0.0, 1e-6);
  EXPECT_NEAR(position.cell_m.x, 558.0, 3.0);
  EXPECT_NEAR(position.cell_m.y, 1114.0, 3.0);
}

TEST(MapPosition, WithoutCrsALatitudeHasToBeSaid) {
  EXPECT_THAT(test::message_of(ErrorKind::usage, [] { make_map_position({}, "", 4, 4, {}); }),
              HasSubstr("latitude"));
  const MapPosition position =
      make_map_position({.cell_x = 100.0, .cell_y = 100.0}, "", 4, 4, 51.0);
  EXPECT_EQ(position.latitude_deg.at(3, 3), 51.0);
  EXPECT_EQ(position.grid_north_deg.at(3, 3), 0.0);
}

TEST(EarthPosition, LiesOnTheGlobe) {
  const auto gulf_of_guinea = earth_position_km(0.0, 0.0);
  EXPECT_NEAR(gulf_of_guinea[0], earth_radius_km, 1e-9);
  EXPECT_NEAR(gulf_of_guinea[1], 0.0, 1e-9);
  const auto padang = earth_position_km(90.0, 0.0);
  EXPECT_NEAR(padang[1], earth_radius_km, 1e-9);
  const auto pole = earth_position_km(17.0, 90.0);
  EXPECT_NEAR(pole[2], earth_radius_km, 1e-9);
  EXPECT_NEAR(pole[0], 0.0, 1e-9);
}

}  // namespace
}  // namespace belvedere
