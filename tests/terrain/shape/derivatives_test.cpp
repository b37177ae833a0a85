#include "terrain/shape/derivatives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "base/filter.h"
#include "base/math.h"
#include "base/parallel.h"
#include "terrain/io/raster_io.h"
#include "terrain/synthetic/synthetic_plan.h"
#include "tests/grids.h"
#include "tests/paths.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

constexpr double surface_cell_m = 20.0;

// f(x, y) in metres, x east and y north of the grid's centre.
template <class F>
Grid<float> surface(int size, F&& f) {
  return test::grid_of(size, size, [&](int x, int y) {
    return f((x - size / 2) * surface_cell_m, (size / 2 - y) * surface_cell_m);
  });
}

TEST(Slope, OfTiltedPlanes) {
  const Grid<float> plane = surface(9, [](double x, double y) { return 0.3 * x - 0.4 * y; });
  EXPECT_NEAR(slope_deg(plane, surface_cell_m, surface_cell_m)(4, 4), to_degrees(std::atan(0.5)),
              1e-4);
  // Cells twice as wide halve the rise to the east.
  EXPECT_NEAR(slope_deg(plane, 2.0 * surface_cell_m, surface_cell_m)(4, 4),
              to_degrees(std::atan(std::hypot(0.15, 0.4))), 1e-4);
  EXPECT_EQ(slope_deg(Grid<float>(4, 4, 100.F), surface_cell_m, surface_cell_m),
            Grid<float>(4, 4, 0.F));
}

TEST(Relief, IsTheDifferenceOfTwoBlurs) {
  const Grid<float> ground = surface(64, [](double x, double y) {
    return 500.0 + 200.0 * std::sin(x / 90.0) * std::cos(y / 70.0);
  });
  const Grid<float> inner = gaussian_blur(ground, 3.0);
  const Grid<float> outer = gaussian_blur(ground, 9.0);
  const Grid<float> above = relief(ground, surface_cell_m, 60.0, 180.0);
  const Grid<float> own = relief(ground, surface_cell_m, 0.0, 180.0);
  for (std::size_t i = 0; i < ground.size(); ++i) {
    ASSERT_FLOAT_EQ(above[i], inner[i] - outer[i]);
    ASSERT_FLOAT_EQ(own[i], ground[i] - outer[i]);
  }
}

TEST(HeightAboveValley, OfAVeeShapedValley) {
  // A floor at 600 m whose flanks rise 1 in 2, cut off 400 m above.
  const Grid<float> valley =
      surface(121, [](double x, double) { return 600.0 + std::min(400.0, 0.5 * std::abs(x)); });
  const Grid<float> height = height_above_valley(valley, surface_cell_m, 300.0);
  EXPECT_NEAR(height(60 + 10, 60), 100.0,
              15.0);  // 200 m off: the floor is in reach, smoothed by a cell
  EXPECT_NEAR(height(60 + 30, 60), 150.0, 1.0);  // 600 m off the reach ends 300 m down the flank
  EXPECT_NEAR(height(60, 60), 0.0, 1e-6);
  for (const float v : height) ASSERT_GE(v, 0.F);
}

TEST(Derivatives, SameBitsForAnyThreadCount) {
  const Grid<float> ground = surface(150, [](double x, double y) {
    return 500.0 + 200.0 * std::sin(x / 90.0) * std::cos(y / 70.0);
  });
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return std::array{slope_deg(ground, 20, 20), relief(ground, 20, 40, 900),
                      height_above_valley(ground, 20, 400)};
  };
  EXPECT_EQ(run(1), run(2));
}

// A raster that GDAL's own programs wrote as plain floats, read without our reader, so that both
// sides are independent.
Grid<float> read_envi(const std::string& path) {
  std::ifstream header(path.substr(0, path.find_last_of('.')) + ".hdr");
  int width = 0;
  int height = 0;
  for (std::string line; std::getline(header, line);) {
    std::istringstream words(line);
    std::string key;
    std::string equals;
    words >> key >> equals;
    if (key == "samples") words >> width;
    if (key == "lines") words >> height;
  }
  Grid<float> grid(width, height);
  std::ifstream data(path, std::ios::binary);
  data.read(reinterpret_cast<char*>(grid.data()),
            static_cast<std::streamsize>(grid.size() * sizeof(float)));
  EXPECT_TRUE(data.good()) << path;
  return grid;
}

TEST(Derivatives, EqualGdaldem) {
  const std::string dem = test::data_folder() + "/lost_river/mackay.tif";
  if (!std::filesystem::exists(dem)) GTEST_SKIP() << "needs " << dem;
  if (std::system("command -v gdaldem gdal_translate > /dev/null") != 0)
    GTEST_SKIP() << "needs GDAL's program gdaldem";
  const std::filesystem::path folder =
      std::filesystem::path(test::build_folder()) / "derivatives_test";
  std::filesystem::create_directories(folder);
  const auto run = [&](const std::string& command, const std::string& name) {
    const std::string out = (folder / name).string();
    EXPECT_EQ(std::system((command + " '" + dem + "' '" + out + "' > /dev/null 2>&1").c_str()), 0)
        << command;
    return read_envi(out);
  };
  const Grid<float> altitude = run("gdal_translate -q -of ENVI -ot Float32", "dem.bin");
  const Grid<float> slope = run("gdaldem slope -q -of ENVI", "slope.bin");
  const Grid<float> our_slope = slope_deg(altitude, 30.0, 30.0);
  double slope_error = 0.0;
  std::size_t compared = 0;
  for (int y = 1; y + 1 < altitude.height(); ++y) {
    for (int x = 1; x + 1 < altitude.width(); ++x) {
      if (slope(x, y) < 0.F) continue;  // a void nearby
      ++compared;
      slope_error =
          std::max(slope_error, std::abs(static_cast<double>(slope(x, y)) - our_slope(x, y)));
    }
  }
  EXPECT_GT(compared, altitude.size() * 9 / 10);
  EXPECT_LE(slope_error, 1e-3);
  RecordProperty("slope_error_deg", std::to_string(slope_error));
  std::filesystem::remove_all(folder);
}

// Bounds leave out the angles that nobody asks for, and change no other.
TEST(Slope, WithinBoundsIsTheSlope) {
  Grid<float> z(60, 50);
  for (std::size_t i = 0; i < z.size(); ++i)
    z[i] = static_cast<float>(30.0 * std::sin(0.13 * static_cast<double>(i % 60)) *
                              std::cos(0.21 * static_cast<double>(i / 60)));
  const Grid<float> all = slope_deg(z, 10.0, 10.0);
  const Grid<float> some = slope_deg(z, 10.0, 10.0, {3.0, 12.0});
  std::size_t between = 0;
  for (std::size_t i = 0; i < z.size(); ++i)
    if (all[i] < 2.999F) {
      EXPECT_EQ(some[i], 0.0F);
    } else if (all[i] > 12.001F) {
      EXPECT_EQ(some[i], 90.0F);
    } else {
      EXPECT_EQ(some[i], all[i]);
      ++between;
    }
  EXPECT_GT(between, 300U);
  EXPECT_LT(between, z.size() - 300U);
}

Grid<float> rough(int width, int height) {
  return test::grid_of(width, height, [&](int x, int y) {
    return 800.F + 900.F * synthetic::ridged_noise(2, x / 40.0, y / 40.0, 5);
  });
}

TEST(Hillshade, LevelGroundAndSlopesInClosedForm) {
  EXPECT_EQ(hillshade(Grid<float>(9, 9, 1200.F), 30.0, 30.0, {})(4, 4),
            std::lround(1.0 + 254.0 * std::sin(0.25 * 3.14159265358979)));
  // A slope of 45° that faces the light is fully lit, one that faces away not at all.
  Grid<float> slope(9, 9);
  for (const auto [x, y] : test::cells(9, 9)) slope(x, y) = 30.F * static_cast<float>(y);
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
  for (const auto [x, y] : test::cells({1, 1, 199, 149}))
    largest = std::max(largest, std::abs(ours.cells(x, y) - theirs.cells(x, y)));
  EXPECT_LE(largest, 1.F);
}

}  // namespace
}  // namespace belvedere
