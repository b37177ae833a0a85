#include "terrain/io/height_encoding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "terrain/io/byte_raster_rows.h"
#include "terrain/io/dem_levels.h"
#include "terrain/io/raster_thinned.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

TEST(HeightEncoding, HeightsOfThePublishedFormulas) {
  const HeightEncoding terrarium = *height_encoding("terrarium");
  EXPECT_EQ(terrarium.metres(128, 0, 0), 0.F);
  EXPECT_EQ(terrarium.metres(132, 210, 128), 1234.5F);
  EXPECT_EQ(terrarium.metres(127, 255, 0), -1.F);
  const HeightEncoding mapbox = *height_encoding("mapbox");
  EXPECT_EQ(mapbox.metres(0, 0, 0), -10000.F);
  EXPECT_NEAR(mapbox.metres(1, 134, 160), 0.F, 1e-3F);     // 100000 steps
  EXPECT_NEAR(mapbox.metres(2, 224, 72), 8848.8F, 1e-3F);  // 188488 steps
  EXPECT_FALSE(height_encoding("Terrarium"));
}

class EncodedRaster : public RasterFiles {
 protected:
  static constexpr int width = 60, height = 40;
  // A slope that crosses steps of the middle byte of both encodings; a hole at (7, 5).
  static float slope(double x, double y) { return static_cast<float>(500.0 + 4.0 * x + 7.5 * y); }

  static DemParameters dem_of(const RasterSource& source) {
    DemParameters parameters;
    parameters.sources = {source};
    return parameters;
  }
  RasterSource write(const std::string& encoding) const {
    ByteRasterLayout layout{
        .frame = {{500000, 5200000, 30, 30}, width, height, normalize_crs("EPSG:32632")},
        .bands = {{"r"}, {"g"}, {"b"}},
        .is_colour = true};
    std::vector<Grid<std::uint8_t>> bands(3, Grid<std::uint8_t>(width, height, 0));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        if (x == 7 && y == 5) continue;
        const double z = static_cast<double>(slope(x, y));
        const auto steps = static_cast<std::uint32_t>(
            std::lround(encoding == "mapbox" ? (z + 10000.0) * 10.0 : (z + 32768.0) * 256.0));
        bands[0](x, y) = static_cast<std::uint8_t>(steps >> 16);
        bands[1](x, y) = static_cast<std::uint8_t>(steps >> 8 & 255U);
        bands[2](x, y) = static_cast<std::uint8_t>(steps & 255U);
      }
    ByteRasterRows file(path("tiles.tif"), layout);
    file.write(0, bands);
    file.commit();
    RasterSource source;
    source.path = path("tiles.tif");
    source.encoding = encoding;
    return source;
  }
};

TEST_F(EncodedRaster, HeightsComeBackInMetresBlackIsVoid) {
  for (const char* encoding : {"terrarium", "mapbox"}) {
    const Dem dem = read_dem(dem_of(write(encoding)), silent_progress());
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        ASSERT_NEAR(dem.altitude_m(x, y), slope(x, y), 0.06F) << encoding << ' ' << x << ' ' << y;
    EXPECT_EQ(dem.filled(7, 5), 1);
    EXPECT_EQ(dem.filled(8, 5), 0);
  }
}

// Half a cell aside, heights are resampled; of colours resampled first they would be off by up to
// 256 m where the middle byte changes.
TEST_F(EncodedRaster, HeightsAreResampledNotColours) {
  const RasterSource source = write("terrarium");
  RasterFrame frame{{500315, 5199685, 30, 30}, 40, 20, normalize_crs("EPSG:32632")};
  const Raster<float> aside = warp_rasters({source}, frame, silent_progress());
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 40; ++x)
      ASSERT_NEAR(aside.cells(x, y), slope(x + 10.5, y + 10.5), 0.02F) << x << ' ' << y;
  const std::optional<Raster<float>> thin = read_thinned(source, 20);
  ASSERT_TRUE(thin);
  for (int y = 1; y < thin->cells.height(); ++y)
    for (int x = 3; x < 20; ++x)
      ASSERT_NEAR(thin->cells(x, y), slope(3.0 * x + 1.0, 3.0 * y + 1.0), 12.F) << x << ' ' << y;
}

TEST_F(EncodedRaster, GroundLargerThanMemoryIsDecodedToo) {
  const DemParameters parameters = dem_of(write("mapbox"));
  const RasterFrame frame = choose_frame(parameters.sources, "", 0.0, {});
  DemLevels levels(parameters, frame, 2, 0.0, silent_progress());
  const Dem whole = levels.whole();
  EXPECT_NEAR(whole.altitude_m(8, 5), slope(32, 20), 0.1F);
  const Dem window = levels.window(0, {20, 10, 30, 20}, whole);
  EXPECT_NEAR(window.altitude_m(3, 4), slope(23, 14), 0.06F);
}

TEST_F(EncodedRaster, WhatIsNotEncodedIsRefused) {
  RasterSource source = write("mapbox");
  source.encoding = "mapzen";
  EXPECT_THAT(error_of([&] { read_raster(source); }).what(), HasSubstr("\"terrarium\""));
  write_ascii("plain.asc", 4, 4, 0, 0, 30, [](int, int) { return "7"; });
  source.path = path("plain.asc");
  source.encoding = "mapbox";
  EXPECT_THAT(error_of([&] { read_raster(source); }).what(), HasSubstr("three bands of 8 bits"));
  source = write("mapbox");
  source.encoding.clear();
  const Error plain = error_of([&] { read_dem(dem_of(source), silent_progress()); });
  EXPECT_THAT(plain.what(), HasSubstr("`encoding = \"terrarium\"`"));
}

}  // namespace
}  // namespace belvedere
