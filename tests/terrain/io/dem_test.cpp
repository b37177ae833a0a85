#include "terrain/io/dem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "tests/paths.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

class DemFiles : public RasterFiles {};

Raster<float> make_slope(int width, int height) {
  Raster<float> raster{
      Grid<float>(width, height), {500000.0, 5200000.0, 30.0, 30.0}, normalize_crs("EPSG:32632")};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      raster.cells(x, y) = 1000.F + 5.F * static_cast<float>(x) - 3.F * static_cast<float>(y);
  return raster;
}

void cut_disc(Grid<float>& cells, double cx, double cy, double radius) {
  for (int y = 0; y < cells.height(); ++y)
    for (int x = 0; x < cells.width(); ++x)
      if (std::hypot(x - cx, y - cy) < radius) cells(x, y) = NAN;
}

TEST(Dem, KeepsWhatIsKnownToTheBit) {
  Raster<float> raster = make_slope(90, 70);
  const Grid<float> whole = raster.cells;
  cut_disc(raster.cells, 45, 30, 12);
  const Dem dem = make_dem(raster);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    ASSERT_EQ(dem.filled[i] != 0, std::isnan(raster.cells[i]));
    if (dem.filled[i] == 0) {
      ASSERT_EQ(dem.altitude_m[i], whole[i]);
    }
  }
  EXPECT_EQ(dem.transform, raster.transform);
  EXPECT_EQ(dem.crs, raster.crs);
}

// A plane is a solution of Laplace's equation, so a hole in it must come back as the plane.
TEST(Dem, AHoleInAPlaneIsFilledByThePlane) {
  for (const double radius : {1.0, 2.5, 6.0, 15.0, 40.0}) {
    Raster<float> raster = make_slope(160, 140);
    const Grid<float> whole = raster.cells;
    cut_disc(raster.cells, 80, 70, radius);
    const Dem dem = make_dem(raster);
    double worst = 0.0;
    for (std::size_t i = 0; i < whole.size(); ++i)
      worst = std::max(worst, std::abs(static_cast<double>(dem.altitude_m[i]) - whole[i]));
    // Of the plane's rise over the hole, 10 m per cell.
    EXPECT_LT(worst, 0.06 * 5.83 * 2.0 * radius + 0.01) << radius;
  }
}

TEST(Dem, FillIsContinuousAtItsRim) {
  Raster<float> raster = make_slope(200, 200);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x)
      raster.cells(x, y) += 200.F * static_cast<float>(std::sin(0.05 * x) * std::cos(0.07 * y));
  double steepest = 0.0;
  for (int y = 0; y < 200; ++y)
    for (int x = 1; x < 200; ++x)
      steepest = std::max(
          steepest, std::abs(static_cast<double>(raster.cells(x, y)) - raster.cells(x - 1, y)));
  cut_disc(raster.cells, 90, 100, 45);
  for (int y = 0; y < 200; ++y)  // and a slanted rim, as reprojected tiles have
    for (int x = 0; x < 4 + y / 20; ++x) raster.cells(x, y) = NAN;
  const Dem dem = make_dem(raster);
  for (int y = 0; y < 200; ++y)
    for (int x = 1; x < 200; ++x) {
      ASSERT_TRUE(std::isfinite(dem.altitude_m(x, y)));
      ASSERT_LT(std::abs(dem.altitude_m(x, y) - dem.altitude_m(x - 1, y)), 2.5 * steepest)
          << x << ' ' << y;
    }
}

TEST(Dem, FillStaysWithinItsRim) {
  Raster<float> raster = make_slope(120, 110);
  cut_disc(raster.cells, 60, 55, 30);
  const auto [low, high] = std::minmax_element(
      raster.cells.begin(), raster.cells.end(),
      [](float a, float b) { return std::isnan(b) ? false : std::isnan(a) || a < b; });
  (void)low;
  const Dem dem = make_dem(raster);
  for (const float z : dem.altitude_m) {
    ASSERT_GE(z, 1000.F - 3.F * 110.F);
    ASSERT_LE(z, *high);
  }
}

TEST(Dem, OneKnownCellFillsAll) {
  Raster<float> raster{Grid<float>(37, 5, NAN), {}, ""};
  raster.cells(30, 4) = 123.F;
  const Dem dem = make_dem(raster);
  for (const float z : dem.altitude_m) ASSERT_FLOAT_EQ(z, 123.F);
  raster.cells(30, 4) = INFINITY;
  EXPECT_EQ(error_of([&] { make_dem(raster); }).kind(), ErrorKind::input);
  EXPECT_EQ(error_of([&] { make_dem({}); }).kind(), ErrorKind::input);
}

TEST(Dem, SameBitsForAnyThreads) {
  Raster<float> raster = make_slope(500, 400);
  for (std::size_t i = 0; i < raster.cells.size(); i += 3)
    raster.cells[i] += static_cast<float>(i % 17);
  cut_disc(raster.cells, 200, 200, 150);
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return make_dem(raster).altitude_m;
  };
  EXPECT_EQ(run(1), run(2));
}

TEST_F(DemFiles, ReadsConvertsFillsAndSaysSo) {
  struct Notes : Progress {
    std::string text;
    void note(std::string_view line) override { text += line; }
  } notes;
  write_ascii("f.asc", 50, 40, 500000, 5200000, 30,
              [](int x, int y) { return x == 20 && y < 10 ? "-9999" : std::to_string(3000 + x); });
  DemParameters parameters;
  parameters.sources.resize(1);
  parameters.sources[0].path = path("f.asc");
  EXPECT_THAT(error_of([&] { read_dem(parameters, notes); }).what(), HasSubstr("`crs`"));
  parameters.sources[0].crs = "EPSG:32632";
  parameters.sources[0].unit_to_m = 0.3048;
  const Dem dem = read_dem(parameters, notes);
  EXPECT_THAT(notes.text, HasSubstr("10 void cells"));
  EXPECT_FLOAT_EQ(dem.altitude_m(10, 5), 3010.F * 0.3048F);
  EXPECT_EQ(dem.filled(20, 9), 1);
  EXPECT_EQ(dem.filled(20, 10), 0);
  EXPECT_NEAR(dem.altitude_m(20, 5), 3020.F * 0.3048F, 0.5);
  EXPECT_EQ(dem.cell_m(), 30.0);

  parameters.max_void_share = 0.004;
  const Error error = error_of([&] { read_dem(parameters, notes); });
  EXPECT_EQ(error.kind(), ErrorKind::input);
  EXPECT_THAT(error.what(), HasSubstr("0.5 %"));
  parameters.cell_m = 1e6;
  EXPECT_EQ(error_of([&] { read_dem(parameters, notes); }).kind(), ErrorKind::usage);
}

// Coordinates in another system than the given one: the ground is read, with a note on its
// position.
TEST_F(DemFiles, APlaceFarFromWhereItsSystemIsUsedIsDoubted) {
  struct Notes : Progress {
    std::string text;
    void note(std::string_view line) override { text += line; }
  };
  const auto notes_of = [&](double east, double north, const char* crs) {
    write_ascii("f.asc", 50, 40, east, north, 30,
                [](int x, int) { return std::to_string(1000 + x); });
    DemParameters parameters;
    parameters.sources.resize(1);
    parameters.sources[0].path = path("f.asc");
    parameters.sources[0].crs = crs;
    Notes notes;
    read_dem(parameters, notes);
    return notes.text;
  };
  EXPECT_EQ(notes_of(500000, 5200000, "EPSG:32632"), "") << "9° E, in its zone";
  EXPECT_EQ(notes_of(950000, 5200000, "EPSG:32632"), "")
      << "15° E, a zone beside it, as maps of large regions have";
  EXPECT_THAT(notes_of(-1620000, 438000, "EPSG:32611"),
              testing::AllOf(HasSubstr("4° N"), HasSubstr("EPSG:32611"), HasSubstr("(`crs`)")));
  EXPECT_EQ(notes_of(-1620000, 438000,
                     "+proj=lcc +lat_1=49 +lat_2=77 +lat_0=49 +lon_0=-95 +datum=NAD83 +units=m"),
            "")
      << "says no area";
}

// Real data, as used by the scenes: size, range of the known altitudes, voids.
struct RealDem {
  const char* file;
  const char* crs;
  const char* frame_crs;
  int width, height;
  double lowest, highest, void_share;
};

class RealDems : public testing::TestWithParam<RealDem> {};

TEST_P(RealDems, AreReadWhole) {
  const RealDem& real = GetParam();
  DemParameters parameters;
  parameters.sources.resize(1);
  parameters.sources[0].path = test::data_folder() + "/" + real.file;
  parameters.sources[0].crs = real.crs;
  if (!std::filesystem::exists(parameters.sources[0].path))
    GTEST_SKIP() << "no " << parameters.sources[0].path;
  const Dem dem = read_dem(parameters, silent_progress());
  EXPECT_EQ(describe_crs(dem.crs), real.frame_crs);
  EXPECT_EQ(dem.width(), real.width);
  EXPECT_EQ(dem.height(), real.height);
  const auto [low, high] = std::minmax_element(dem.altitude_m.begin(), dem.altitude_m.end());
  EXPECT_NEAR(*low, real.lowest, 1.0);
  EXPECT_NEAR(*high, real.highest, 1.0);
  const auto filled = std::count(dem.filled.begin(), dem.filled.end(), 1);
  EXPECT_NEAR(static_cast<double>(filled) / static_cast<double>(dem.filled.size()), real.void_share,
              0.001);
}

INSTANTIATE_TEST_SUITE_P(
    All, RealDems,
    testing::Values(
        RealDem{"innsbruck/innsbruck_utm32_30m.tif", "", "EPSG:32632", 2391, 3785, 472.8, 3457.0,
                0.0199},
        RealDem{"rainier/mt_rainier_90m.tif", "", "EPSG:32610", 1026, 1464, 263.0, 4371.0, 0.0464},
        RealDem{"lost_river/mackay.tif", "", "EPSG:32612", 738, 919, 1732.6, 3645.3, 0.0},
        RealDem{"big_tujunga/bigtujunga.tif", "", "EPSG:32611", 1197, 643, 315.0, 2295.0, 0.0},
        RealDem{"lolo_peak/example_lcp.tif", "", "EPSG:32611", 502, 515, 964.0, 2794.0, 0.0},
        RealDem{"glacier_np/elevation.asc", "EPSG:3978", "EPSG:3978", 771, 726, 300.0, 3000.0,
                0.1698},
        RealDem{"zion/srtm.tif", "", "EPSG:32612", 427, 521, 1028.5, 2892.0, 0.0459},
        RealDem{"aletsch/aletsch.tif", "", "EPSG:2056", 358, 310, 502.0, 4216.3, 0.0},
        RealDem{"oetztal/srtm_oetztal.tif", "", "EPSG:32632", 496, 548, 390.0, 3727.0, 0.0486}));

}  // namespace
}  // namespace belvedere
