#include "tools/cli/terrain_operators.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/tools/read_options.h"

namespace belvedere::tools {
namespace {

using ::testing::HasSubstr;

TerrainOperators read_operators(const std::string& line) {
  return test::read_options<TerrainOperators>(add_terrain_operators, line);
}

// A cone with stripes of ±1 m along rows.
Grid<float> striped_cone() {
  return test::grid_of(60, 50, [&](int x, int y) {
    return 900.0 - 8.0 * std::hypot(x - 30, y - 25) + (y % 2 == 0 ? 1.0 : -1.0);
  });
}

TEST(TerrainOperators, AreOffUnlessAskedFor) {
  const Grid<float> cone = striped_cone();
  Progress progress;
  EXPECT_FALSE(read_operators("").destripe);
  EXPECT_FALSE(read_operators("").line_integral);
  EXPECT_EQ(operate_after_bands(cone, {}, {}, 30.0, read_operators(""), progress), cone);
}

TEST(TerrainOperators, EachIsRead) {
  EXPECT_TRUE(read_operators("--destripe").destripe);
  EXPECT_TRUE(read_operators("--line-integral").line_integral);
  EXPECT_EQ(read_operators("--widen-valleys 60").widen_valleys_m, 60.F);
}

TEST(TerrainOperators, ContoursNeedAFileForTheirInterval) {
  EXPECT_EQ(read_operators("--contours a.gpkg --contour-interval 20").contour_interval_m, 20.0);
  EXPECT_THROW(read_operators("--contour-interval 20"), Error);
}

TEST(TerrainOperators, ProductsLieInTheGridOfTheResult) {
  const test::Folder folder;
  Raster<float> cone{
      striped_cone(), {600000.0, 5200000.0, 30.0, 30.0}, normalize_crs("EPSG:32632")};
  const TerrainOperators operators{.hillshade = folder / "relief.tif",
                                   .contours = folder / "lines.geojson"};
  Progress progress;
  write_products(cone, operators, progress);
  RasterSource source;
  source.path = operators.hillshade;
  const Raster<float> relief = read_raster(source);
  EXPECT_EQ(relief.transform, cone.transform);
  EXPECT_EQ(relief.cells.width(), 60);
  EXPECT_THAT(test::read_bytes(operators.contours), HasSubstr("LineString"));
  EXPECT_EQ(folder.count(), 2U);
}

TEST(ElevationOptions, SayWhatASceneSaysOfItsSources) {
  const auto read = [](const std::string& line) {
    return elevation_source("a.nc",
                            test::read_options<ElevationOptions>(add_elevation_options, line));
  };
  const RasterSource source = read("--encoding mapbox --variable height");
  EXPECT_EQ(source.path, "a.nc");
  EXPECT_EQ(source.encoding, "mapbox");
  EXPECT_EQ(source.variable, "height");
  EXPECT_EQ(read("").encoding, "");
  EXPECT_THAT(test::usage_error([&] { read("--encoding png"); }), testing::HasSubstr("terrarium"));
}

}  // namespace
}  // namespace belvedere::tools
