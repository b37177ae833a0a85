#include "terrain/io/raster_io.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/filter.h"
#include "terrain/generalize/line_integral_generalize.h"
#include "terrain/synthetic/synthetic_plan.h"
#include "tests/grids.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

class Contours : public RasterFiles {};

// A cone of 30°, its summit at the centre.
Raster<float> make_cone() {
  Raster<float> cone{
      Grid<float>(201, 201), {600000.0, 5206030.0, 30.0, 30.0}, normalize_crs("EPSG:32611")};
  for (const auto [x, y] : test::cells(201, 201))
    cone.cells(x, y) =
        static_cast<float>(2500.0 - std::hypot(x - 100.0, y - 100.0) * 30.0 * 0.57735);
  return cone;
}

TEST_F(Contours, ConesHaveCircles) {
  for (const char* name : {"cone.gpkg", "cone.geojson", "cone.shp"}) {
    Raster<float> cone = make_cone();
    for (float& z : cone.cells) z = std::max(z, 1010.F);
    const ContourSummary summary = write_contours(path(name), cone, {250.0, 0.0});
    // 1250, 1500, 1750, 2000, 2250 m; the summit itself has no line. Radius: depth below the summit
    // / tan 30°.
    double length = 0.0;
    for (const double level : {1250.0, 1500.0, 1750.0, 2000.0, 2250.0})
      length += 2.0 * 3.14159265358979 * (2500.0 - level) / 0.57735;
    EXPECT_NEAR(summary.length, length, 0.005 * length) << name;
    EXPECT_LE(summary.lines, 6) << name;
    EXPECT_GE(summary.lines, 5) << name;
    EXPECT_TRUE(std::filesystem::exists(path(name)));
    EXPECT_FALSE(std::filesystem::exists(path(std::string(name) + ".tmp")));
  }
  EXPECT_TRUE(std::filesystem::exists(path("cone.prj")));
}

TEST_F(Contours, AltitudesAndCrsAreWritten) {
  write_contours(path("cone.geojson"), make_cone(), {400.0, 100.0});
  const std::string text = read_text("cone.geojson");
  EXPECT_NE(text.find("\"altitude_m\": 2100"), std::string::npos) << text.substr(0, 600);
  EXPECT_NE(text.find("32611"), std::string::npos);
  EXPECT_EQ(text.find("\"altitude_m\": 2000"), std::string::npos);
}

TEST_F(Contours, VoidsHaveNone) {
  Raster<float> cone = make_cone();
  const double whole = write_contours(path("a.gpkg"), cone, {100.0, 0.0}).length;
  for (const auto [x, y] : test::cells(100, 201)) cone.cells(x, y) = NAN;
  EXPECT_NEAR(write_contours(path("a.gpkg"), cone, {100.0, 0.0}).length, 0.5 * whole,
              0.02 * whole);  // written over
}

TEST_F(Contours, GeneralizedTerrainHasShorterLines) {
  Raster<float> raster{
      Grid<float>(150, 150), {600000.0, 5206030.0, 30.0, 30.0}, normalize_crs("EPSG:32611")};
  for (const auto [x, y] : test::cells(150, 150))
    raster.cells(x, y) = 900.F + 1400.F * synthetic::ridged_noise(2, x / 60.0, y / 60.0, 6);
  const double before = write_contours(path("before.gpkg"), raster, {50.0, 0.0}).length;
  raster.cells = generalize_along_slope_lines(raster.cells, {}, 30.0, {}, silent_progress());
  EXPECT_LT(write_contours(path("after.gpkg"), raster, {50.0, 0.0}).length, 0.8 * before);
}

TEST_F(Contours, FaultsLeaveWhatWasThere) {
  write_text("old.geojson", "the old file");
  EXPECT_EQ(error_of([&] {
              write_contours(path("old.geojson"), make_cone(), {0.0, 0.0});
            }).kind(),
            ErrorKind::usage);
  EXPECT_EQ(read_text("old.geojson"), "the old file");
  EXPECT_EQ(error_of([&] { write_contours(path("a.dxf"), make_cone(), {}); }).kind(),
            ErrorKind::output);
  EXPECT_EQ(error_of([&] { write_contours(path("no/folder/a.gpkg"), make_cone(), {}); }).kind(),
            ErrorKind::output);
  EXPECT_EQ(folder_.count(), 1U);
}

}  // namespace
}  // namespace belvedere
