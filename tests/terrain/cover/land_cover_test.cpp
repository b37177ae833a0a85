#include "terrain/cover/land_cover.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "terrain/io/dem.h"
#include "tests/grids.h"
#include "tests/paths.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

using enum LandCoverClass;
using testing::HasSubstr;

class LandCoverFiles : public RasterFiles {};

// One metre per cell, so that positions are cells; corners at whole numbers, y upwards from -height
// to 0.
LandCover make_cover(int width, int height,
                     const std::function<LandCoverClass(double, double)>& at_centre) {
  LandCover cover{{Grid<LandCoverClass>(width, height), {0.0, 0.0, 1.0, 1.0}, ""}};
  for (const auto [x, y] : test::cells(width, height))
    cover.classes.cells(x, y) = at_centre(x + 0.5, y + 0.5);
  return cover;
}

// Where forest ends going east along y, to a thousandth of a cell.
double border_at(const LandCover& cover, double y, double from, double to) {
  EXPECT_EQ(cover.at(from, -y), forest);
  EXPECT_NE(cover.at(to, -y), forest);
  while (to - from > 1e-4) {
    const double centre = 0.5 * (from + to);
    (cover.at(centre, -y) == forest ? from : to) = centre;
  }
  return 0.5 * (from + to);
}

TEST(LandCoverAt, StraightBordersStay) {
  const LandCover cover =
      make_cover(40, 30, [](double x, double) { return x < 17.0 ? forest : rock; });
  for (double y = 0.05; y < 30.0; y += 0.31)
    EXPECT_NEAR(border_at(cover, y, 5.0, 35.0), 17.0, 1e-3);
  const LandCover level =
      make_cover(40, 30, [](double, double y) { return y < 17.0 ? forest : rock; });
  for (double x = 0.05; x < 40.0; x += 0.31) {
    EXPECT_EQ(level.at(x, -16.999), forest);
    EXPECT_EQ(level.at(x, -17.001), rock);
  }
}

// The staircase of cells along a slanted border, against the ideal line.
TEST(LandCoverAt, StairsBecomeLines) {
  for (const double slope : {1.0, 0.5, 1.0 / 3.0, 0.7, 0.21}) {
    const auto line = [slope](double y) {
      return 30.27 + slope * (y - 30.0);
    };  // .27: through no cell centre
    const LandCover cover =
        make_cover(60, 60, [&](double x, double y) { return x < line(y) ? forest : rock; });
    double worst = 0.0, worst_cells = 0.0;
    for (double y = 6.0; y < 54.0; y += 0.037) {
      const double off =
          std::abs(border_at(cover, y, 1.0, 59.0) - line(y)) / std::hypot(1.0, slope);
      worst = std::max(worst, off);
      const double cell_border = std::ceil(line(std::floor(y) + 0.5) - 0.5);
      worst_cells = std::max(worst_cells, std::abs(cell_border - line(y)) / std::hypot(1.0, slope));
    }
    EXPECT_LT(worst, slope < 0.5 ? 0.4 : 0.35)
        << slope;  // long shallow steps keep more of themselves
    EXPECT_LT(worst, 0.75 * worst_cells) << slope;
  }
}

TEST(LandCoverAt, DiscsKeepTheirArea) {
  for (const double radius : {5.0, 9.3, 20.0}) {
    const LandCover cover = make_cover(60, 60, [&](double x, double y) {
      return std::hypot(x - 30.2, y - 29.6) < radius ? water : forest;
    });
    std::size_t inside = 0;
    constexpr double step = 0.05;
    for (double y = step / 2; y < 60.0; y += step)
      for (double x = step / 2; x < 60.0; x += step) inside += cover.at(x, -y) == water ? 1U : 0U;
    EXPECT_NEAR(static_cast<double>(inside) * step * step / (std::numbers::pi * radius * radius),
                1.0, radius < 6.0 ? 0.04 : 0.02)
        << radius;
  }
}

// The formula itself, without optimizations.
TEST(LandCoverAt, IsTheLargestSplineMembership) {
  const auto cell = [](int x, int y) {
    return static_cast<LandCoverClass>(1 + (x * 7 + y * 13 + x * y) % 5);
  };
  const LandCover cover = make_cover(
      23, 19, [&](double x, double y) { return cell(static_cast<int>(x), static_cast<int>(y)); });
  const auto spline = [](double d) {
    d = std::abs(d);
    return d < 1.0   ? 2.0 / 3.0 - d * d + d * d * d / 2.0
           : d < 2.0 ? std::pow(2.0 - d, 3.0) / 6.0
                     : 0.0;
  };
  for (double y = -3.013; y < 22.0; y += 0.173)
    for (double x = -3.007; x < 26.0; x += 0.191) {
      std::array<double, land_cover_class_count> membership{};
      for (const auto [u, v] : test::cells({-8, -8, 34, 30}))
        membership[static_cast<std::size_t>(cover.classes.cells.clamped(u, v))] +=
            spline(u + 0.5 - x) * spline(v + 0.5 - y);
      const auto found = static_cast<std::size_t>(cover.at(x, -y));
      for (std::size_t c = 0; c < membership.size(); ++c)
        ASSERT_GE(membership[found], membership[c] - 1e-9) << x << ' ' << y;
    }
}

TEST(LandCoverAt, TiesGoToTheLowerId) {
  const LandCover cover = make_cover(8, 8, [](double x, double) { return x < 4.0 ? rock : water; });
  EXPECT_EQ(cover.at(4.0, -4.0), water);
  const LandCover other = make_cover(8, 8, [](double x, double) { return x < 4.0 ? water : rock; });
  EXPECT_EQ(other.at(4.0, -4.0), water);
}

TEST(LandCoverAt, GoesOnBeyondTheRaster) {
  const LandCover cover = make_cover(1, 1, [](double, double) { return snow; });
  for (const double x : {-1e300, -5.0, 0.5, 7.0, 1e300}) EXPECT_EQ(cover.at(x, -x), snow);
}

std::string two_codes(int x, int) { return x < 10 ? "42" : x == 10 ? "250" : "11"; }

RasterFrame frame_of(const std::string& file) {
  RasterSource source;
  source.path = file;
  source.crs = "EPSG:32632";
  return choose_frame({source}, "", 0.0, {});
}

TEST_F(LandCoverFiles, CodesBecomeClasses) {
  const std::string file = write_ascii("c.asc", 30, 20, 500000, 5200000, 30, two_codes);
  LandCoverParameters parameters;
  parameters.sources.resize(1);
  parameters.sources[0].path = file;
  parameters.sources[0].crs = "EPSG:32632";
  parameters.legend = "nlcd";
  const LandCover cover = read_land_cover(parameters, frame_of(file), silent_progress());
  EXPECT_EQ(cover.classes.cells.width(), 30);
  EXPECT_EQ(cover.classes.cells(3, 3), forest);
  EXPECT_EQ(cover.classes.cells(20, 3), water);
  EXPECT_NE(cover.classes.cells(10, 3),
            sky);  // 250 is the legend's own nodata: taken from beside it
  parameters.nodata = snow;
  EXPECT_EQ(read_land_cover(parameters, frame_of(file), silent_progress()).classes.cells(10, 3),
            snow);
}

TEST_F(LandCoverFiles, UnknownCodesAreCountedUnlessMapped) {
  const std::string file = write_ascii("c.asc", 30, 20, 500000, 5200000, 30, [](int x, int y) {
    return x < 2 ? "77" : y == 0 ? "78" : "41";
  });
  LandCoverParameters parameters;
  parameters.sources.resize(1);
  parameters.sources[0].path = file;
  parameters.sources[0].crs = "EPSG:32632";
  parameters.legend = "nlcd";
  const Error error =
      error_of([&] { read_land_cover(parameters, frame_of(file), silent_progress()); });
  EXPECT_EQ(error.kind(), ErrorKind::input);
  EXPECT_THAT(error.what(), HasSubstr("77 (40 cells), 78 (28 cells)"));
  EXPECT_THAT(error.what(), HasSubstr("`unknown`"));
  parameters.unknown = rock;
  const LandCover cover = read_land_cover(parameters, frame_of(file), silent_progress());
  EXPECT_EQ(cover.classes.cells(0, 5), rock);
  EXPECT_EQ(cover.classes.cells(9, 0), rock);
  EXPECT_EQ(cover.classes.cells(9, 5), forest);
}

TEST_F(LandCoverFiles, OutsideOfTheDataIsAnError) {
  const std::string file = write_ascii("c.asc", 30, 20, 500000, 5200000, 30, two_codes);
  LandCoverParameters parameters;
  parameters.sources.resize(1);
  parameters.sources[0].path = file;
  parameters.legend = "nlcd";
  EXPECT_EQ(
      error_of([&] { read_land_cover(parameters, frame_of(file), silent_progress()); }).kind(),
      ErrorKind::input);  // no CRS
  parameters.sources[0].crs = "EPSG:32632";
  RasterFrame far = frame_of(file);
  far.transform.origin_x += 1e5;
  const Error elsewhere = error_of([&] { read_land_cover(parameters, far, silent_progress()); });
  EXPECT_EQ(elsewhere.kind(), ErrorKind::input);
  EXPECT_THAT(elsewhere.what(), HasSubstr("c.asc"));
  EXPECT_THAT(elsewhere.found(), HasSubstr("land cover lies elsewhere"));
  EXPECT_THAT(elsewhere.found(),
              HasSubstr("46.96° N 9.01° E; the terrain around 46.95° N 10.32° E"));
  EXPECT_THAT(elsewhere.allowed(), HasSubstr("`crs`"));
}

double share(const LandCover& cover, LandCoverClass id) {
  const auto& cells = cover.classes.cells;
  return static_cast<double>(std::count(cells.begin(), cells.end(), id)) /
         static_cast<double>(cells.size());
}

LandCover read_real(const std::string& dem_file, const std::string& cover_file, int band,
                    const std::string& crs, const std::string& legend, const std::string& folder) {
  const std::string data = test::data_folder() + "/";
  DemParameters terrain;
  terrain.sources.resize(1);
  terrain.sources[0].path = data + dem_file;
  terrain.sources[0].crs = crs;
  const Dem dem = read_dem(terrain, silent_progress());
  LandCoverParameters parameters;
  parameters.sources = terrain.sources;
  parameters.sources[0].path = data + cover_file;
  parameters.sources[0].band = band;
  parameters.legend = legend;
  parameters.folders = {data + folder};
  return read_land_cover(parameters, {dem.transform, dem.width(), dem.height(), dem.crs},
                         silent_progress());
}

bool has_real_data() { return std::filesystem::exists(test::data_folder() + "/lolo_peak"); }

TEST(RealLandCover, LoloPeakFromFuelModels) {
  if (!has_real_data()) GTEST_SKIP() << "no " << test::data_folder();
  const LandCover cover =
      read_real("lolo_peak/example_lcp.tif", "lolo_peak/example_lcp.tif", 4, "", "fbfm40", "");
  // Counted in the raster itself: 11898 cells of 99, 957 of 98.
  EXPECT_NEAR(share(cover, rock), 11898.0 / (502 * 515), 1e-6);
  EXPECT_NEAR(share(cover, water), 957.0 / (502 * 515), 1e-6);
  EXPECT_NEAR(share(cover, sky), 0.0, 0.0);
}

TEST(RealLandCover, ZionAcrossTwoCrs) {
  if (!has_real_data()) GTEST_SKIP() << "no " << test::data_folder();
  const LandCover cover = read_real("zion/srtm.tif", "zion/nlcd2011.tif", 1, "", "nlcd", "");
  EXPECT_NEAR(share(cover, forest), 0.526, 0.01);
  EXPECT_NEAR(share(cover, shrub), 0.380, 0.01);
  EXPECT_EQ(share(cover, sky), 0.0);
}

TEST(RealLandCover, GlacierParkWithItsTable) {
  if (!has_real_data()) GTEST_SKIP() << "no " << test::data_folder();
  const std::string legend = test::source_folder() + "/scenes/legends/canada_fbp.toml";
  const LandCover cover =
      read_real("glacier_np/elevation.asc", "glacier_np/Forest.asc", 1, "EPSG:3978", legend, "");
  EXPECT_NEAR(share(cover, forest), 0.69, 0.03);
  EXPECT_NEAR(share(cover, water), 0.023, 0.01);
  EXPECT_EQ(share(cover, sky), 0.0);
}

}  // namespace
}  // namespace belvedere
