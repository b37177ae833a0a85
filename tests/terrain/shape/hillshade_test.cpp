#include "terrain/shape/hillshade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "terrain/io/raster_io.h"
#include "terrain/synthetic/synthetic_noise.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

Grid<float> rough(int width, int height) {
  Grid<float> grid(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      grid(x, y) = 800.F + 900.F * synthetic::ridged_noise(2, x / 40.0, y / 40.0, 5);
  return grid;
}

TEST(Hillshade, LevelGroundAndSlopesInClosedForm) {
  EXPECT_EQ(hillshade(Grid<float>(9, 9, 1200.F), 30.0, 30.0, {})(4, 4),
            std::lround(1.0 + 254.0 * std::sin(0.25 * 3.14159265358979)));
  // A slope of 45° that faces the light is fully lit, one that faces away not at all.
  Grid<float> slope(9, 9);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 9; ++x) slope(x, y) = 30.F * static_cast<float>(y);
  EXPECT_EQ(hillshade(slope, 30.0, 30.0, {0.F, 45.F, 1.F})(4, 4), 255);
  EXPECT_EQ(hillshade(slope, 30.0, 30.0, {180.F, 40.F, 1.F})(4, 4), 1);
  EXPECT_EQ(hillshade(slope, 60.0, 30.0, {0.F, 45.F, 1.F})(4, 4), 255);  // cells need not be square
}

TEST(Hillshade, VoidsAreZero) {
  Grid<float> terrain = rough(20, 20);
  terrain(7, 9) = NAN;
  const Grid<std::uint8_t> shade = hillshade(terrain, 30.0, 30.0, {});
  EXPECT_EQ(shade(7, 9), 0);
  EXPECT_EQ(shade(8, 10), 0);
  EXPECT_NE(shade(9, 9), 0);
}

class HillshadeFiles : public RasterFiles {};

TEST_F(HillshadeFiles, IsWhatGdaldemMakes) {
  if (std::system("command -v gdaldem > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "gdaldem is not installed";
  const Raster<float> raster{
      rough(200, 150), {500000.0, 5200000.0, 30.0, 25.0}, normalize_crs("EPSG:32611")};
  write_raster(path("dem.tif"), raster);
  ASSERT_EQ(std::system(("gdaldem hillshade -q -az 290 -alt 35 -z 1.5 " + path("dem.tif") + " " +
                         path("theirs.tif"))
                            .c_str()),
            0);
  write_raster(path("ours.tif"),
               Raster<std::uint8_t>{hillshade(raster.cells, 30.0, 25.0, {290.F, 35.F, 1.5F}),
                                    raster.transform, raster.crs});
  RasterSource source;
  source.path = path("theirs.tif");
  const Raster<float> theirs = read_raster(source);
  source.path = path("ours.tif");
  const Raster<float> ours = read_raster(source);
  EXPECT_EQ(ours.transform, theirs.transform);
  EXPECT_EQ(read_raster_info(source).nodata, 0.0);
  float largest = 0.F;
  for (int y = 1; y < 149; ++y)
    for (int x = 1; x < 199; ++x)
      largest = std::max(largest, std::abs(ours.cells(x, y) - theirs.cells(x, y)));
  EXPECT_LE(largest, 1.F);
}

}  // namespace
}  // namespace belvedere
