// Areas assembled from synthetic tiles with known heights.
#include "terrain/fetch/fetch_area.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/config.h"
#include "tests/grids.h"
#include "tests/paths.h"
#include "tests/terrain/fetch/served_tiles.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;

using FetchArea = ServedTiles;

// Linear in degrees: cubic convolution and linear rows between parts reproduce it exactly, for any
// cell width.
double slant(double longitude, double latitude) {
  return 900.0 + 40.0 * (longitude - 11.0) + 25.0 * (latitude - 47.0);
}
constexpr double rounding_m =
    0.02;  // of floats, and of places between control points of a reprojection

TEST(FetchFrame, LiesAroundThePlaceOnTheZonesLattice) {
  FetchParameters parameters;
  parameters.at_lonlat = {11.4, 47.35};
  parameters.size_km = {60.0, 40.0};
  const RasterFrame frame = fetch_frame(parameters, 30.0);
  EXPECT_EQ(describe_crs(frame.crs), "EPSG:32632");
  EXPECT_EQ(std::fmod(frame.transform.origin_x, 30.0), 0.0);
  EXPECT_EQ(std::fmod(frame.transform.origin_y, 30.0), 0.0);
  const glm::dvec2 centre = transform_point("EPSG:4326", frame.crs, parameters.at_lonlat);
  const glm::dvec2 end = frame.transform.to_crs(frame.width - 0.5, frame.height - 0.5);
  EXPECT_LE(frame.transform.origin_x, centre.x - 30000.0);
  EXPECT_GT(frame.transform.origin_x, centre.x - 30030.0);
  EXPECT_GE(end.x, centre.x + 30000.0);
  EXPECT_LT(end.x, centre.x + 30030.0);
  EXPECT_LE(end.y, centre.y - 20000.0);
  EXPECT_GT(end.y, centre.y - 20030.0);
}

TEST(FetchFrame, FollowsHemisphereZoneAndPole) {
  const auto crs_at = [](double longitude, double latitude) {
    FetchParameters parameters;
    parameters.at_lonlat = {longitude, latitude};
    return describe_crs(fetch_frame(parameters, 30.0).crs);
  };
  EXPECT_EQ(crs_at(-72.5, -13.2), "EPSG:32718");
  EXPECT_EQ(crs_at(179.9, -17.0), "EPSG:32760");
  EXPECT_EQ(crs_at(-180.0, -17.0), "EPSG:32701");
  EXPECT_EQ(crs_at(-30.0, 84.5), "EPSG:32661");
  for (const glm::dvec2 at : {glm::dvec2(0.0, 89.9), glm::dvec2(10.0, -90.0)}) {
    FetchParameters parameters;
    parameters.at_lonlat = at;
    EXPECT_THAT(test::usage_error([&] { fetch_frame(parameters, 30.0); }), HasSubstr("pole"));
  }
  FetchParameters swapped;
  swapped.at_lonlat = {47.0, 111.0};
  EXPECT_THAT(test::usage_error([&] { fetch_frame(swapped, 30.0); }), HasSubstr("longitude first"));
}

TEST_F(FetchArea, FourTilesJoinWithoutASeam) {
  const MapSource source = elevation_source();
  for (int west : {10, 11})
    for (int south : {46, 47}) serve_tile(source, west, south, slant);
  serve();
  const FetchedArea area = fetch(parameters({11.01, 46.99}, 60.0));
  EXPECT_THAT(area.elevation.tiles, SizeIs(4));
  const Raster<float> dem = elevation();
  EXPECT_EQ(dem.cells.width(), area.elevation.frame.width);
  EXPECT_LT(largest_error(dem, slant), rounding_m);
}

// At 50° cells change their width: parts of 120 and 80 columns.
TEST_F(FetchArea, CellsOfTwoWidthsJoinWithoutASeam) {
  const MapSource source = elevation_source();
  const auto hills = [](double longitude, double latitude) {
    return 500.0 + 80.0 * (longitude - 11.0) + 300.0 * (latitude - 50.0);
  };
  for (int west : {10, 11, 12})
    for (int south : {49, 50}) serve_tile(source, west, south, hills);
  serve();
  EXPECT_THAT(fetch(parameters({11.5, 50.0}, 40.0)).elevation.tiles, SizeIs(2));
  EXPECT_LT(largest_error(elevation(), hills), rounding_m);
  // And where cells of the result are so wide that many are averaged.
  FetchParameters p = parameters({11.5, 50.0}, 40.0);
  p.cell_m = 4000.0;
  fetch(p, "coarse");
  EXPECT_LT(largest_error(elevation("coarse"), hills), 0.5);
}

TEST_F(FetchArea, TheDateLineIsNoBorder) {
  const MapSource source = elevation_source();
  const auto hills = [](double longitude, double latitude) {
    return 400.0 + 100.0 * (longitude - (longitude < 0.0 ? -180.0 : 180.0)) +
           50.0 * (latitude + 17.0);
  };
  const auto from_east = [&](double longitude, double latitude) {
    return 400.0 + 100.0 * (longitude - 180.0) + 50.0 * (latitude + 17.0);
  };
  serve_tile(source, 179, -17, from_east);
  serve_tile(source, 180, -17, from_east);
  serve();
  const FetchedArea area = fetch(parameters({179.95, -16.5}, 40.0));
  EXPECT_EQ(area.elevation.tiles[0].name, "S17E179");
  EXPECT_EQ(area.elevation.tiles[1].name, "S17W180");
  EXPECT_LT(largest_error(elevation(), hills), rounding_m);
}

// An island: the tile to its east is missing.
TEST_F(FetchArea, ATileThatIsNotThereIsSea) {
  const MapSource source = elevation_source();
  const auto island = [](double longitude, double latitude) {
    return std::max(0.0, 1500.0 - 9000.0 * std::hypot(longitude - 9.6, latitude - 42.5));
  };
  serve_tile(source, 9, 42, island);
  serve();
  EXPECT_TRUE(fetch(parameters({9.95, 42.5}, 50.0)).elevation.tiles[1].about.missing);
  EXPECT_THAT(progress_.text(), HasSubstr("N42E010"));
  const Raster<float> dem = elevation();
  const PointTransform to_degrees(dem.crs, "EPSG:4326");
  int sea = 0;
  for (const auto [x, y] : test::cells(dem.cells))
    if (to_degrees.apply(dem.transform.to_crs(x, y)).x > 10.0) {
      EXPECT_EQ(dem.cells(x, y), 0.0F);
      ++sea;
    }
  EXPECT_GT(sea, 500);
  EXPECT_GT(*std::max_element(dem.cells.begin(), dem.cells.end()), 1000.0F);
}

// Services withhold tiles. Ground that ends in a wall at the border of a tile is not a coast.
TEST_F(FetchArea, AMissingTileBesideHighGroundIsNoSea) {
  const MapSource source = elevation_source();
  serve_tile(source, 44, 39, [](double, double) { return 1400.0; });
  serve();
  const std::string message = test::input_error([&] { fetch(parameters({44.5, 39.95}, 40.0)); });
  EXPECT_THAT(message,
              AllOf(HasSubstr("N40E044"), HasSubstr("not sea"), HasSubstr("copernicus_glo90")));
  EXPECT_FALSE(std::filesystem::exists(path("out/elevation.tif")));
  EXPECT_TRUE(std::filesystem::is_empty(path("out")));
}

// Two missing tiles meet at a corner only, so each is judged by its own neighbours.
TEST_F(FetchArea, OnlyTheMissingTileBesideHighGroundIsNamed) {
  const MapSource source = elevation_source();
  // High ground north-west of a diagonal that passes the corner.
  const auto slope = [](double longitude, double latitude) {
    return latitude - 40.0 > longitude - 44.95 ? 1400.0 : 0.0;
  };
  serve_tile(source, 44, 39, slope);
  serve_tile(source, 45, 40, slope);
  serve();
  const std::string message = test::input_error([&] { fetch(parameters({45.0, 40.0}, 40.0)); });
  EXPECT_THAT(message, HasSubstr("the tiles N40E044, and the ground next to them is not sea"));
}

// The altitude at one end of a group of missing tiles decides for all of it.
TEST_F(FetchArea, AdjacentMissingTilesAreJudgedTogether) {
  const MapSource source = elevation_source();
  serve_tile(source, 44, 39, [](double, double) { return 1400.0; });
  serve();
  const std::string message = test::input_error([&] { fetch(parameters({45.0, 40.0}, 40.0)); });
  EXPECT_THAT(message, AllOf(HasSubstr("N40E044"), HasSubstr("N39E045"), HasSubstr("N40E045")));
}

TEST_F(FetchArea, NothingAtAllIsAnError) {
  serve();
  EXPECT_THAT(test::input_error([&] {
                fetch(parameters({-30.5, 20.5}, 40.0));
              }),
              HasSubstr("none of the 1 tiles"));
}

TEST_F(FetchArea, OtherMeaningsOfMissingTiles) {
  serve_tile(elevation_source(), 9, 42, [](double, double) { return 0.0; });
  serve();
  FetchParameters p = parameters({9.95, 42.5}, 50.0);
  p.elevation = write("strict.toml", elevation_toml(120, "missing = \"error\""));
  EXPECT_THAT(test::input_error([&] { fetch(p); }), HasSubstr("lacks the tiles N42E010"));
  p.elevation = write("holes.toml", elevation_toml(120, "missing = \"nothing\""));
  fetch(p);
  const Raster<float> dem = elevation();
  EXPECT_TRUE(std::isnan(dem.cells(dem.cells.width() - 1, dem.cells.height() / 2)));
}

TEST_F(FetchArea, ATileOfAnotherGridIsRefused) {
  const std::string elsewhere = serve_tile(elevation_source(), 12, 47, slant);
  std::filesystem::copy_file(elsewhere, path("served/dem/N47_00_E011_00_DEM.tif"));
  serve();
  EXPECT_THAT(test::input_error([&] {
                fetch(parameters({11.5, 47.5}, 40.0));
              }),
              AllOf(HasSubstr("N47_00_E011"), HasSubstr("the tile begins at 11.99")));
  std::filesystem::remove(path("served/dem/N47_00_E011_00_DEM.tif"));
  std::filesystem::copy_file(serve_tile(elevation_source(60), 11, 47, slant),
                             path("served/dem/other.tif"));
  FetchParameters refreshed = parameters({11.5, 47.5}, 40.0);
  refreshed.refresh = true;
  EXPECT_THAT(test::input_error([&] { fetch(refreshed); }), HasSubstr("60 × 60 cells"));
}

// Codes are unchanged; where tiles are missing, low ground is sea and the rest unknown.
TEST_F(FetchArea, LandCoverKeepsItsCodesAndGetsItsSea) {
  const MapSource heights = elevation_source();
  const MapSource cover = parse_map_source(cover_toml(), "test_cover.toml");
  // A shore that falls to the sea at 12.0° E, with a rock off it; the land-cover tile east of 12°
  // is missing.
  const auto shore = [](double longitude, double latitude) {
    if (std::hypot(longitude - 12.2, latitude - 43.5) < 0.03) return 60.0;
    return longitude < 11.95 ? 200.0 : 0.0;
  };
  for (int west : {11, 12}) serve_tile(heights, west, 43, shore);
  const auto codes = [](double longitude, double latitude) {
    return longitude > 11.95 ? 80.0 : latitude > 43.5 ? 10.0 : 40.0;
  };
  serve_tile(cover, 9, 42, codes);
  serve();
  const FetchedArea area = fetch(parameters({12.0, 43.5}, 50.0, true));
  ASSERT_TRUE(area.land_cover.has_value());
  EXPECT_EQ(area.land_cover->source.legend, "esa_worldcover");
  RasterSource source;
  source.path = path("out/land_cover.tif");
  const Raster<std::int32_t> read = read_codes(source);
  const PointTransform to_degrees(read.crs, "EPSG:4326");
  int unknown = 0;
  for (const auto [x, y] : test::cells(read.cells)) {
    const glm::dvec2 at = to_degrees.apply(read.transform.to_crs(x, y));
    const double cell = 3.0 / 1200.0;
    if (std::hypot(at.x - 12.2, at.y - 43.5) < 0.05) {
      unknown += read.cells(x, y) < 0 ? 1 : 0;
      continue;
    }
    if (std::abs(at.x - 11.95) < cell || std::abs(at.y - 43.5) < cell) continue;
    ASSERT_EQ(read.cells(x, y), static_cast<int>(codes(at.x, at.y))) << at.x << ", " << at.y;
  }
  EXPECT_GT(unknown, 100);
  EXPECT_THAT(progress_.text(), HasSubstr("their class is unknown"));
}

TEST_F(FetchArea, WiderCellsOfLandCoverAreOnesOfTheSource) {
  const MapSource cover = parse_map_source(cover_toml(), "test_cover.toml");
  serve_tile(elevation_source(), 10, 43, slant);
  serve_tile(cover, 9, 42, [](double longitude, double) { return longitude < 10.5 ? 10.0 : 40.0; });
  serve();
  FetchParameters p = parameters({10.5, 43.5}, 60.0, true);
  p.cover_cell_m = 1000.0;
  EXPECT_EQ(fetch(p).land_cover->frame.transform.cell_x, 1000.0);
  RasterSource source;
  source.path = path("out/land_cover.tif");
  const Raster<std::int32_t> read = read_codes(source);
  EXPECT_EQ(read.cells(2, 30), 10);
  EXPECT_EQ(read.cells(read.cells.width() - 3, 30), 40);
}

TEST_F(FetchArea, TheRecordSaysWhereEveryCellComesFrom) {
  const std::string file = serve_tile(elevation_source(), 11, 47, slant);
  test::write_bytes(file + ".tag", "\"edition-7\"");
  serve();
  const FetchedArea area = fetch(parameters({11.5, 47.5}, 40.0));
  EXPECT_EQ(area.elevation.origin, "Test heights (2021), tiles N47E011; fetched 2027-01-15");
  EXPECT_EQ(area.elevation.licence, "© who measured. free with credit");
  EXPECT_THAT(area.elevation.get_from, HasSubstr("belvedere fetch --at 11.5,47.5"));
  const std::string record = test::read_bytes(area.record);
  EXPECT_NE(find(as_table(parse_config(record, "fetched.toml"), "x"), "fetched"), nullptr);
  EXPECT_THAT(record,
              AllOf(HasSubstr("credit = \"© who measured"),
                    HasSubstr("address = \"" + mirror() + "dem/N47_00_E011_00_DEM.tif\""),
                    HasSubstr("edition-7"), HasSubstr("hash = \"" + area.elevation.hash + "\"")));
  // From the cache the same bytes, and the date of the request.
  now_ += 10 * 86400;
  const std::string first = test::read_bytes(path("out/elevation.tif"));
  fetch(parameters({11.5, 47.5}, 40.0), "again");
  EXPECT_TRUE(test::read_bytes(path("again/elevation.tif")) == first);
  EXPECT_EQ(test::read_bytes(path("again/fetched.toml")), record);
  EXPECT_THAT(
      fetch_record(parameters({11.5, 47.5}, 40.0), area,
                   [](const FetchedArea& of) { return "head of " + of.elevation.file + "\n"; }),
      HasSubstr("head of elevation.tif\n\n[request]"));
}

TEST_F(FetchArea, WhoeverStopsItLeavesNothingBehind) {
  class Stopping : public Progress {
    void advance(double) override {
      if (++calls_ == 4) throw Error(ErrorKind::interrupted, "", "stopped");
    }
    int calls_ = 0;
  };
  serve_tile(elevation_source(), 11, 47, slant);
  serve();
  Stopping progress;
  EXPECT_EQ(test::error_of([&] {
              fetch_area(parameters({11.5, 47.5}, 40.0), path("out"), cache_, progress);
            }).kind(),
            ErrorKind::interrupted);
  EXPECT_TRUE(std::filesystem::is_empty(path("out")));
}

class FetchAreaLong : public FetchArea {};

// The built-in source at its true size: the tile N47E011 made of real ground, compared with that
// ground.
TEST_F(FetchAreaLong, RealGroundComesBackAsItWas) {
  RasterSource ground;
  ground.path = test::data_folder() + "/innsbruck/innsbruck_utm32_30m.tif";
  if (!std::filesystem::exists(ground.path)) GTEST_SKIP() << "no " << ground.path;
  const MapSource source = read_map_source("copernicus_glo30");
  const double cell = 1.0 / 3600.0;
  const RasterFrame tile{
      {11.0 - 0.5 * cell, 48.0 + 0.5 * cell, cell, cell}, 3600, 3600, normalize_crs("EPSG:4326")};
  Raster<float> raster = warp_rasters({ground}, tile, progress_);
  const std::string name = "Copernicus_DSM_COG_10_N47_00_E011_00_DEM";
  std::filesystem::create_directories(path("served/" + name));
  write_raster(path("served/" + name + "/" + name + ".tif"), raster);
  serve();
  FetchParameters p = parameters({11.45, 47.45}, 20.0);
  p.elevation = "copernicus_glo30";
  const FetchedArea area = fetch(p);
  const Raster<float> dem = elevation();
  const Raster<float> true_ground = warp_rasters({ground}, area.elevation.frame, progress_);
  double sum = 0.0;
  for (std::size_t i = 0; i < dem.cells.size(); ++i)
    sum += std::pow(dem.cells[i] - true_ground.cells[i], 2.0);
  EXPECT_LT(std::sqrt(sum / static_cast<double>(dem.cells.size())),
            2.0);  // m; twice resampled in steep limestone
  // Only the part of a file of tens of megabytes that lies in the area.
  EXPECT_LT(area.bytes,
            std::filesystem::file_size(path("served/" + name + "/" + name + ".tif")) / 2);
}

}  // namespace
}  // namespace belvedere
