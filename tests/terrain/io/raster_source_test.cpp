#include "terrain/io/raster_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "terrain/io/raster_io.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Files of several rasters, as GDAL's own program writes them, and grids as text.
class RasterOfSeveral : public RasterFiles {
 protected:
  static bool has_gdal_translate() {
    return std::system("command -v gdal_translate > /dev/null") == 0;
  }
  bool translate(const std::string& options, const std::string& from, const std::string& to) const {
    return std::system(("gdal_translate -q " + options + " '" + path(from) + "' '" + path(to) +
                        "' > /dev/null 2>&1")
                           .c_str()) == 0;
  }
  // Heights 1000 + x and codes 20 + y, of 12 × 8 cells.
  void write_two() const {
    write_ascii("dem.asc", 12, 8, 500000, 5200000, 30,
                [](int x, int) { return std::to_string(1000 + x); });
    write_ascii("cover.asc", 12, 8, 500000, 5200000, 30,
                [](int, int y) { return std::to_string(20 + y); });
  }
  RasterSource source(const std::string& name, const std::string& variable = {}) const {
    RasterSource out;
    out.path = path(name);
    out.crs = "EPSG:32632";
    out.variable = variable;
    return out;
  }
};

TEST_F(RasterOfSeveral, NetCdfListsItsVariablesAndTakesOne) {
  if (!has_gdal_translate()) GTEST_SKIP() << "needs GDAL's program gdal_translate";
  write_two();
  const auto band = [](int number, const std::string& file) {
    return "<VRTRasterBand dataType=\"Float32\" band=\"" + std::to_string(number) +
           "\"><SimpleSource><SourceFilename relativeToVRT=\"1\">" + file +
           "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand>";
  };
  write_text("two.vrt",
             "<VRTDataset rasterXSize=\"12\" rasterYSize=\"8\"><SRS>EPSG:32632</SRS><GeoTransform>"
             "500000,30,0,5200240,0,-30</GeoTransform>" +
                 band(1, "dem.asc") + band(2, "cover.asc") + "</VRTDataset>");
  ASSERT_TRUE(translate("-of netCDF", "two.vrt", "two.nc"));
  EXPECT_THAT(error_of([&] { read_raster(source("two.nc")); }).what(),
              AllOf(HasSubstr("2 rasters: Band1, Band2"), HasSubstr("`variable = \"Band1\"`")));
  EXPECT_EQ(read_raster(source("two.nc", "Band1")).cells(7, 2), 1007.F);
  const Raster<std::int32_t> codes = read_codes(source("two.nc", "Band2"));
  EXPECT_EQ(codes.cells(7, 2), 22);
  EXPECT_EQ(codes.transform, (GeoTransform{500000, 5200240, 30, 30}));
  EXPECT_THAT(error_of([&] { read_raster(source("two.nc", "elevation")); }).what(),
              AllOf(HasSubstr("\"elevation\""), HasSubstr("Band1, Band2")));
  // Of one variable the name is checked as well.
  ASSERT_TRUE(translate("-of netCDF -a_srs EPSG:32632", "dem.asc", "one.nc"));
  EXPECT_EQ(read_raster(source("one.nc", "Band1")).cells(7, 2), 1007.F);
  EXPECT_THAT(error_of([&] { read_raster(source("one.nc", "z")); }).what(), HasSubstr("Band1"));
}

TEST_F(RasterOfSeveral, GeoPackageListsItsTablesAndTakesOne) {
  if (!has_gdal_translate()) GTEST_SKIP() << "needs GDAL's program gdal_translate";
  write_two();
  const std::string options = "-of GPKG -ot Float32 -a_srs EPSG:32632 -co TILE_FORMAT=TIFF ";
  ASSERT_TRUE(translate(options + "-co RASTER_TABLE=heights", "dem.asc", "two.gpkg"));
  EXPECT_EQ(read_raster(source("two.gpkg")).cells(7, 2), 1007.F) << "one raster needs no name";
  ASSERT_TRUE(translate(options + "-co RASTER_TABLE=cover -co APPEND_SUBDATASET=YES", "cover.asc",
                        "two.gpkg"));
  EXPECT_THAT(error_of([&] { read_raster(source("two.gpkg")); }).what(),
              AllOf(HasSubstr("heights"), HasSubstr("cover"), HasSubstr("`variable = ")));
  EXPECT_EQ(read_raster(source("two.gpkg", "heights")).cells(7, 2), 1007.F);
  EXPECT_EQ(read_raster(source("two.gpkg", "cover")).cells(7, 2), 22.F);
}

TEST_F(RasterOfSeveral, OfPagesOfATiffTheLargestIsRead) {
  if (!has_gdal_translate()) GTEST_SKIP() << "needs GDAL's program gdal_translate";
  write_two();
  const std::string more = "-co APPEND_SUBDATASET=YES -a_srs EPSG:32632 ";
  ASSERT_TRUE(translate("-a_srs EPSG:32632 -outsize 3 2", "dem.asc", "pages.tif"));
  ASSERT_TRUE(translate(more, "dem.asc", "pages.tif"));
  EXPECT_EQ(read_raster(source("pages.tif")).cells.width(), 12);
  EXPECT_EQ(read_raster(source("pages.tif")).cells(7, 2), 1007.F);
  EXPECT_EQ(read_raster(source("pages.tif", "1")).cells.width(), 3);
  ASSERT_TRUE(translate(more, "cover.asc", "pages.tif"));
  EXPECT_THAT(error_of([&] { read_raster(source("pages.tif")); }).what(),
              AllOf(HasSubstr("12 × 8 cells: 2, 3"), HasSubstr("`variable = \"2\"`")));
  EXPECT_EQ(read_codes(source("pages.tif", "3")).cells(7, 2), 22);
}

TEST_F(RasterOfSeveral, AFileOfOneHasNoNames) {
  write_two();
  EXPECT_THAT(error_of([&] { read_raster(source("dem.asc", "dem")); }).what(),
              HasSubstr("without `variable`"));
}

TEST_F(RasterOfSeveral, TextOfXYZIsAGrid) {
  std::string text = "x y z\n";
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 6; ++x)
      text += std::to_string(500015 + 30 * x) + " " + std::to_string(5200135 - 30 * y) + " " +
              std::to_string(700.25 + x + 10 * y) + "\n";
  for (const char* name : {"dem.xyz", "dem.txt", "dem.csv"}) {
    write_text(name, text);
    const Raster<float> raster = read_raster(source(name));
    EXPECT_EQ(raster.transform, (GeoTransform{500000, 5200150, 30, 30})) << name;
    ASSERT_EQ(raster.cells.width(), 6) << name;
    EXPECT_EQ(raster.cells(4, 3), 734.25F) << name;
  }
  RasterSource bare = source("dem.xyz");
  bare.crs.clear();
  EXPECT_THAT(
      error_of([&] {
        warp_rasters({bare}, {{500000, 5200150, 30, 30}, 6, 5, "EPSG:32632"}, silent_progress());
      }).what(),
      HasSubstr("`crs`"));
  write_text("scattered.xyz", "500015 5200135 7\n500040 5200131 8\n500019 5200099 9\n");
  EXPECT_THAT(error_of([&] { read_raster(source("scattered.xyz")); }).what(),
              HasSubstr("gdal_grid"));
}

TEST_F(RasterOfSeveral, OtherFormatsAreRefusedWithTheCommandThatConvertsThem) {
  write_text("dem.pgm", "P5\n4 3\n255\n" + std::string(12, '\7'));
  EXPECT_THAT(error_of([&] { read_raster(source("dem.pgm")); }).what(),
              HasSubstr("gdal_translate dem.pgm heights.tif"));
}

}  // namespace
}  // namespace belvedere
