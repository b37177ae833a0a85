#include "terrain/io/raster_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "base/parallel.h"
#include "terrain/io/raster_file.h"
#include "tests/grids.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

class RasterIo : public RasterFiles {};

TEST_F(RasterIo, GeoTiffComesBackToTheBit) {
  Raster<float> raster =
      make_hills(300, 170, {652049.036943126, 5320655.789191568, 30.0, 30.0}, "EPSG:32632");
  raster.cells(7, 9) = NAN;
  write_raster(path("a.tif"), raster);
  const Raster<float> back = read_raster(source_of(path("a.tif")));
  EXPECT_EQ(back.transform, raster.transform);
  EXPECT_EQ(describe_crs(back.crs), "EPSG:32632");
  ASSERT_TRUE(back.cells.same_size(raster.cells));
  for (std::size_t i = 0; i < raster.cells.size(); ++i) {
    ASSERT_EQ(std::isnan(back.cells[i]), std::isnan(raster.cells[i]));
    if (!std::isnan(raster.cells[i])) {
      ASSERT_EQ(back.cells[i], raster.cells[i]) << i;
    }
  }
  const RasterInfo info = read_raster_info(source_of(path("a.tif")));
  EXPECT_EQ(info.driver, "GTiff");
  EXPECT_EQ(info.bands, 1);
  EXPECT_FALSE(info.geographic);
  EXPECT_EQ(info.nodata, -9999.0);
}

TEST_F(RasterIo, AsciiComesBackToTheBit) {
  Raster<float> raster = make_hills(31, 17, {652049.25, 5320655.5, 12.5, 12.5}, "EPSG:32632");
  raster.cells(30, 16) = NAN;
  write_raster(path("a.asc"), raster);
  const Raster<float> back = read_raster(source_of(path("a.asc")));
  EXPECT_EQ(back.transform, raster.transform);
  EXPECT_EQ(describe_crs(back.crs), "EPSG:32632");
  for (std::size_t i = 0; i + 1 < raster.cells.size(); ++i)
    ASSERT_EQ(back.cells[i], raster.cells[i]) << i;
  EXPECT_TRUE(std::isnan(back.cells(30, 16)));
}

TEST_F(RasterIo, NodataOfEveryKindIsVoid) {
  const auto grid = [&](const std::string& value, const std::string& nodata) {
    write_ascii(
        "n.asc", 3, 2, 0, 0, 30, [&](int x, int y) { return x == 1 && y == 0 ? value : "12.5"; },
        nodata);
    return read_raster(source_of(path("n.asc"))).cells;
  };
  for (const char* value : {"-9999", "-32768", "32767", "nan"}) {
    const Grid<float> bare = grid(value, "");
    EXPECT_TRUE(std::isnan(bare(1, 0))) << value;
    EXPECT_EQ(bare(0, 0), 12.5F);
    EXPECT_EQ(bare(1, 1), 12.5F);
    EXPECT_TRUE(std::isnan(grid(value, value)(1, 0))) << value << " declared";
  }
  EXPECT_TRUE(std::isnan(grid("77", "77")(1, 0)));
  EXPECT_TRUE(std::isnan(grid("-3.4028234663852886e+38", "-3.4028234663852886e+38")(1, 0)));
  EXPECT_EQ(grid("-9999", "77")(1, 0),
            -9999.F);  // where the file names another, this one is a depth
  RasterSource source = source_of(path("n.asc"));
  source.nodata = 12.5;
  EXPECT_TRUE(std::isnan(read_raster(source).cells(0, 0)));
  source.nodata.reset();
  source.lowest_m = 0.0;  // for files with odd values of their own
  source.highest_m = 12.0;
  EXPECT_TRUE(std::isnan(read_raster(source).cells(1, 0)));
  EXPECT_TRUE(std::isnan(read_raster(source).cells(0, 0)));
  source.highest_m = 12.5;
  EXPECT_EQ(read_raster(source).cells(0, 0), 12.5F);
}

TEST_F(RasterIo, CodesKeepNothingBelowZero) {
  write_ascii(
      "c.asc", 4, 1, 0, 0, 30,
      [](int x, int) {
        return std::array{"41", "-9999", "255", "-3"}[static_cast<std::size_t>(x)];
      },
      "255");
  EXPECT_THAT(read_codes(source_of(path("c.asc"))).cells, testing::ElementsAre(41, -1, -1, -1));
  write_ascii(
      "first.asc", 2, 1, 0, 0, 30, [](int x, int) { return x == 0 ? "255" : "7"; }, "255");
  EXPECT_THAT(read_codes(source_of(path("first.asc"))).cells, testing::ElementsAre(-1, 7));
}

TEST_F(RasterIo, FeetBecomeMetres) {
  write_ascii("f.asc", 2, 1, 0, 0, 30, [](int, int) { return "1000.5"; });
  RasterSource source = source_of(path("f.asc"));
  EXPECT_EQ(read_raster(source).cells(0, 0), 1000.5F);
  source.unit_to_m = 0.3048;
  EXPECT_FLOAT_EQ(read_raster(source).cells(0, 0), 304.9524F);
  // Given by the file itself, in a VRT's band; so are scale and offset.
  const auto with = [&](const std::string& tags) {
    write_text(
        "f.vrt",
        R"(<VRTDataset rasterXSize="2" rasterYSize="1"><GeoTransform>0,30,0,0,0,-30</GeoTransform>
      <VRTRasterBand dataType="Float32" band="1">)" +
            tags + R"(<SimpleSource><SourceFilename relativeToVRT="1">f.asc</SourceFilename>
      <SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>)");
    return source_of(path("f.vrt"));
  };
  EXPECT_FLOAT_EQ(read_raster(with("<UnitType>ft</UnitType>")).cells(0, 0), 304.9524F);
  EXPECT_FLOAT_EQ(read_raster(with("<UnitType>us-ft</UnitType>")).cells(1, 0),
                  1000.5F * 1200.F / 3937.F);
  EXPECT_FLOAT_EQ(read_raster(with("<Offset>5</Offset><Scale>0.1</Scale>")).cells(0, 0), 105.05F);
  const Error odd = error_of([&] { read_raster(with("<UnitType>degrees</UnitType>")); });
  EXPECT_EQ(odd.kind(), ErrorKind::input);
  EXPECT_THAT(odd.allowed(), HasSubstr("`unit`"));
}

TEST_F(RasterIo, NoCrsIsAnErrorThatNamesItsKey) {
  write_ascii("n.asc", 4, 4, 500000, 5000000, 30, [](int, int) { return "5"; });
  EXPECT_THAT(test::input_error([&] { choose_frame({source_of(path("n.asc"))}, "", 0.0, {}); }),
              HasSubstr("`crs`"));
  const RasterFrame frame = choose_frame({source_of(path("n.asc"), "EPSG:32632")}, "", 0.0, {});
  EXPECT_EQ(
      error_of([&] { warp_rasters({source_of(path("n.asc"))}, frame, silent_progress()); }).kind(),
      ErrorKind::input);
  EXPECT_EQ(frame.width, 4);
  EXPECT_EQ(frame.transform, (GeoTransform{500000.0, 5000120.0, 30.0, 30.0}));
  EXPECT_EQ(error_of([&] {
              choose_frame({source_of(path("n.asc"), "EPSG:banana")}, "", 0.0, {});
            }).kind(),
            ErrorKind::usage);
}

TEST_F(RasterIo, PointsAreLongitudeFirst) {
  // The Goldenes Dachl in Innsbruck.
  const glm::dvec2 utm = transform_point("EPSG:4326", "EPSG:32632", {11.3933, 47.2686});
  EXPECT_NEAR(utm.x, 681040.0, 150.0);
  EXPECT_NEAR(utm.y, 5237750.0, 150.0);
  const glm::dvec2 back = transform_point("EPSG:32632", "EPSG:4326", utm);
  EXPECT_NEAR(back.x, 11.3933, 1e-9);
  EXPECT_NEAR(back.y, 47.2686, 1e-9);
  EXPECT_EQ(describe_crs(normalize_crs("EPSG:32632")), "EPSG:32632");
  EXPECT_EQ(error_of([] { normalize_crs("nonsense"); }).kind(), ErrorKind::usage);
  EXPECT_EQ(error_of([] { normalize_crs("http://127.0.0.1:9/crs"); }).kind(), ErrorKind::usage);
  write_text("crs.txt", normalize_crs("EPSG:32632"));
  EXPECT_EQ(error_of([&] { normalize_crs(path("crs.txt")); }).kind(),
            ErrorKind::usage);  // reads no files
}

TEST_F(RasterIo, GeographicDataGetTheirUtmZone) {
  write_ascii("g.asc", 60, 40, 11.0, 47.0, 1.0 / 1200.0, [](int, int) { return "5"; });
  const RasterSource source = source_of(path("g.asc"), "EPSG:4326");
  const RasterFrame frame = choose_frame({source}, "", 0.0, {});
  EXPECT_EQ(describe_crs(frame.crs), "EPSG:32632");
  EXPECT_EQ(frame.transform.cell_x, frame.transform.cell_y);
  // 3″ are 92.66 m from north to south and 63.3 m from west to east here; the cell has their area.
  EXPECT_NEAR(frame.transform.cell_x, std::sqrt(92.66 * 63.3), 0.3);
  EXPECT_THAT(test::usage_error([&] { choose_frame({source}, "EPSG:3857", 0.0, {}); }),
              HasSubstr("EPSG:32632"));
  EXPECT_EQ(error_of([&] { choose_frame({source}, "EPSG:4326", 0.0, {}); }).kind(),
            ErrorKind::usage);
}

TEST_F(RasterIo, WebMercatorAndFeetAreNotTakenForMetres) {
  write_ascii("m.asc", 4, 4, 1268000, 5985000, 30, [](int, int) { return "5"; });
  EXPECT_EQ(describe_crs(choose_frame({source_of(path("m.asc"), "EPSG:3857")}, "", 0.0, {}).crs),
            "EPSG:32632");
  // Washington South in US survey feet.
  write_ascii("f.asc", 4, 4, 1200000, 500000, 100, [](int, int) { return "5"; });
  const RasterFrame frame = choose_frame({source_of(path("f.asc"), "EPSG:2286")}, "", 0.0, {});
  EXPECT_EQ(describe_crs(frame.crs), "EPSG:32610");
  EXPECT_NEAR(frame.transform.cell_x, 30.48, 0.1);
}

TEST_F(RasterIo, ExtentCutsToWholeCells) {
  write_raster(path("a.tif"), make_hills(100, 80, {500000.0, 5200000.0, 30.0, 30.0}, "EPSG:32632"));
  const RasterSource source = source_of(path("a.tif"));
  const RasterFrame frame = choose_frame(
      {source}, "", 0.0, std::array<double, 4>{500100.0, 5199000.0, 500400.0, 5199500.0});
  EXPECT_EQ(frame.transform, (GeoTransform{500090.0, 5199520.0, 30.0, 30.0}));
  EXPECT_EQ(frame.width, 11);
  EXPECT_EQ(frame.height, 18);
  const Raster<float> whole = read_raster(source);
  const Raster<float> part = warp_rasters({source}, frame, silent_progress());
  EXPECT_EQ(part.cells(0, 0), whole.cells(3, 16));
  EXPECT_EQ(part.cells(10, 17), whole.cells(13, 33));
  EXPECT_EQ(error_of([&] {
              choose_frame({source}, "", 0.0, std::array<double, 4>{0, 0, 10, 10});
            }).kind(),
            ErrorKind::input);
  EXPECT_EQ(error_of([&] {
              choose_frame({source}, "", 0.0, std::array<double, 4>{10, 0, 0, 10});
            }).kind(),
            ErrorKind::usage);
  EXPECT_EQ(error_of([&] { choose_frame({source}, "", 1e-5, {}); }).kind(), ErrorKind::limit);
}

// The same hills in the grid of another UTM zone: the result must be the hills, wherever the cells
// were.
TEST_F(RasterIo, ReprojectionFindsTheSameGround) {
  const GeoTransform transform{300000.0, 5230000.0, 30.0, 30.0};
  const PointTransform to_32("EPSG:32633", "EPSG:32632");
  const PointTransform to_33("EPSG:32632", "EPSG:32633");
  Raster<float> there{Grid<float>(300, 260), transform, normalize_crs("EPSG:32633")};
  for (const auto [x, y] : test::cells(300, 260)) {
    const glm::dvec2 p = to_32.apply(transform.to_crs(x, y));
    there.cells(x, y) = hills(p.x, p.y);
  }
  write_raster(path("b.tif"), there);
  const RasterSource source = source_of(path("b.tif"));
  const RasterFrame frame = choose_frame({source}, "EPSG:32632", 30.0, {});
  const Raster<float> here = warp_rasters({source}, frame, silent_progress());
  double worst = 0.0;
  std::size_t known = 0;
  for (const auto [x, y] : test::cells(frame.width, frame.height)) {
    if (std::isnan(here.cells(x, y))) continue;
    const glm::dvec2 p = frame.transform.to_crs(x, y);
    // The outermost cell ring is interpolated from one side only.
    const glm::dvec2 there_p = to_33.apply(p);
    const glm::dvec2 cell = transform.to_cell(there_p.x, there_p.y);
    if (cell.x < 2 || cell.y < 2 || cell.x > 297 || cell.y > 257) continue;
    ++known;
    worst = std::max(worst, std::abs(static_cast<double>(here.cells(x, y)) - hills(p.x, p.y)));
  }
  EXPECT_GT(known, 70000U);
  EXPECT_LT(worst, 0.35);  // cubic error of the hills at 30 m; half a cell's shift would be 10 m
}

TEST_F(RasterIo, SouthUpAndRotatedRastersComeUpright) {
  const Raster<float> raster = make_hills(40, 30, {500000.0, 5200000.0, 30.0, 30.0}, "EPSG:32632");
  write_raster(path("a.tif"), raster);
  const auto vrt = [&](const std::string& name, const std::string& transform) {
    write_text(
        name,
        R"(<VRTDataset rasterXSize="40" rasterYSize="30"><SRS>EPSG:32632</SRS><GeoTransform>)" +
            transform +
            R"(</GeoTransform><VRTRasterBand dataType="Float32" band="1"><NoDataValue>-9999</NoDataValue><SimpleSource>
      <SourceFilename relativeToVRT="1">a.tif</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>)");
    return source_of(path(name));
  };
  const Raster<float> south_up = read_raster(vrt("s.vrt", "500000,30,0,5199100,0,30"));
  EXPECT_EQ(south_up.transform, raster.transform);
  for (const auto [x, y] : test::cells(40, 30))
    ASSERT_EQ(south_up.cells(x, y), raster.cells(x, 29 - y));
  // A quarter turn: columns run south, rows run west.
  const Raster<float> turned = read_raster(vrt("r.vrt", "500900,0,-30,5200000,-30,0"));
  ASSERT_EQ(turned.cells.width(), 30);
  ASSERT_EQ(turned.cells.height(), 40);
  EXPECT_EQ(turned.transform, raster.transform);
  for (const auto [x, y] : test::cells(30, 40))
    ASSERT_EQ(turned.cells(x, y), raster.cells(y, 29 - x));
}

TEST_F(RasterIo, TilesJoinWithoutSeamAndTheFirstWins) {
  const Raster<float> whole = make_hills(100, 60, {500000.0, 5200000.0, 30.0, 30.0}, "EPSG:32632");
  const auto part = [&](int x0, int x1, float shift) {
    Raster<float> raster{
        Grid<float>(x1 - x0, 60), {500000.0 + 30.0 * x0, 5200000.0, 30.0, 30.0}, whole.crs};
    for (const auto [x, y] : test::cells({x0, 0, x1, 60}))
      raster.cells(x - x0, y) = whole.cells(x, y) + shift;
    return raster;
  };
  write_raster(path("whole.tif"), whole);
  write_raster(path("west.tif"), part(0, 50, 0.F));
  write_raster(path("east.tif"), part(50, 100, 0.F));
  // Half a cell off, so that every value is interpolated, also across the seam.
  RasterFrame frame{{500015.0, 5199985.0, 30.0, 30.0}, 99, 59, whole.crs};
  const Raster<float> one = warp_rasters({source_of(path("whole.tif"))}, frame, silent_progress());
  const Raster<float> two = warp_rasters({source_of(path("west.tif")), source_of(path("east.tif"))},
                                         frame, silent_progress());
  EXPECT_EQ(one.cells, two.cells);
  // Where they overlap, earlier sources take precedence; later ones fill their voids.
  Raster<float> upper = part(0, 70, 500.F);
  upper.cells(20, 20) = NAN;
  write_raster(path("upper.tif"), upper);
  const RasterFrame all =
      choose_frame({source_of(path("upper.tif")), source_of(path("whole.tif"))}, "", 0.0, {});
  const Raster<float> both = warp_rasters(
      {source_of(path("upper.tif")), source_of(path("whole.tif"))}, all, silent_progress());
  EXPECT_EQ(both.cells(10, 10), upper.cells(10, 10));
  EXPECT_EQ(both.cells(20, 20), whole.cells(20, 20));
  EXPECT_EQ(both.cells(90, 10), whole.cells(90, 10));
}

// Two tiles of degrees on both sides of 180°, in either order, and one that goes on beyond 180.
TEST_F(RasterIo, TilesMeetAtTheDateLine) {
  const auto tile = [&](const std::string& name, double west) {
    return source_of(
        write_ascii(name, 60, 50, west, -17.0, 0.001,
                    [&](int x, int y) {
                      const double east = west < 0.0 ? west + 360.0 : west;
                      return std::to_string(1000.0 + 5e3 * (east + 0.001 * x - 180.0) + 2.0 * y);
                    }),
        "EPSG:4326");
  };
  const RasterSource west = tile("w.asc", 179.94);
  const RasterSource east = tile("e.asc", -180.0);
  for (const std::vector<RasterSource>& sources :
       {std::vector{west, east}, {east, west}, {west, tile("b.asc", 180.0)}}) {
    const RasterFrame frame = choose_frame(sources, "", 0.0, {});
    EXPECT_LT(frame.width, 160);
    EXPECT_LT(frame.height, 160);
    const Raster<float> raster = warp_rasters(sources, frame, silent_progress());
    const PointTransform to_degrees(frame.crs, "EPSG:4326");
    int known = 0;
    for (int y = 10; y < frame.height - 10; y += 7)
      for (int x = 10; x < frame.width - 10; x += 3) {
        const glm::dvec2 at = to_degrees.apply(frame.transform.to_crs(x, y));
        const double lon = at.x < 0.0 ? at.x + 360.0 : at.x;
        if (!(std::abs(lon - 180.0) < 0.055 && at.y > -16.995 && at.y < -16.955)) continue;
        ++known;
        const double row = (-16.95 - at.y) / 0.001 - 0.5;
        EXPECT_NEAR(raster.cells(x, y), 1000.0 + 5e3 * (lon - 180.0005) + 2.0 * row, 0.5)
            << lon << ' ' << at.y;
      }
    EXPECT_GT(known, 100);
  }
}

TEST_F(RasterIo, FilesNameWhatHelpsTheirUsers) {
  const auto message = [&](const std::string& file) {
    return test::input_error([&] { read_raster_info(source_of(file)); });
  };
  EXPECT_THAT(message(write_text("a.tif", "PK\x03\x04")),
              testing::AllOf(HasSubstr("zip archive"), HasSubstr("unpack it")));
  EXPECT_THAT(message(write_text("karwendel.hgt", std::string(2 * 1201 * 1201, '\0'))),
              HasSubstr("N47E011.hgt"));
}

TEST_F(RasterIo, TilesOfDifferentCrsMeet) {
  // The same plane z = northing of zone 32, in two zones that overlap.
  const auto plane = [&](const std::string& name, const std::string& crs, glm::dvec2 origin) {
    const GeoTransform transform{origin.x, origin.y, 30.0, 30.0};
    const PointTransform to_32(crs, "EPSG:32632");
    Raster<float> raster{Grid<float>(60, 60), transform, normalize_crs(crs)};
    for (const auto [x, y] : test::cells(60, 60))
      raster.cells(x, y) = static_cast<float>(to_32.apply(transform.to_crs(x, y)).y - 5.2e6);
    write_raster(path(name), raster);
    return source_of(path(name));
  };
  const glm::dvec2 corner{730000.0, 5230000.0};
  const RasterSource a = plane("a.tif", "EPSG:32632", corner);
  const glm::dvec2 other =
      transform_point("EPSG:32632", "EPSG:32633", corner + glm::dvec2{1500.0, 0.0});
  const RasterSource b = plane("b.tif", "EPSG:32633", other);
  const RasterFrame frame = choose_frame({a, b}, "", 0.0, {});
  EXPECT_EQ(describe_crs(frame.crs), "EPSG:32632");
  const Raster<float> both = warp_rasters({a, b}, frame, silent_progress());
  std::size_t known = 0;
  for (const auto [x, y] : test::cells(frame.width, frame.height)) {
    if (std::isnan(both.cells(x, y))) continue;
    ++known;
    // Border cells of b are constant over half a cell.
    ASSERT_NEAR(both.cells(x, y), frame.transform.to_crs(x, y).y - 5.2e6, 16.0);
  }
  EXPECT_GT(known, 6000U);
}

TEST_F(RasterIo, FinerSourcesAreAveraged) {
  // A checkerboard of ±100 m is averaged away in cells ten times as wide.
  write_ascii("c.asc", 400, 400, 500000, 5200000, 3,
              [](int x, int y) { return (x + y) % 2 == 0 ? "900" : "1100"; });
  const RasterSource source = source_of(path("c.asc"), "EPSG:32632");
  const RasterFrame frame = choose_frame({source}, "", 30.0, {});
  const Raster<float> coarse = warp_rasters({source}, frame, silent_progress());
  for (const auto [x, y] : test::cells({2, 2, frame.width - 2, frame.height - 2}))
    ASSERT_NEAR(coarse.cells(x, y), 1000.0, 1.0);
}

TEST_F(RasterIo, LakesStayFlatBesideSlopes) {
  write_ascii("l.asc", 60, 60, 500000, 5200000, 30,
              [](int x, int) { return x < 30 ? "500" : std::to_string(500 + 25 * (x - 29)); });
  const RasterSource source = source_of(path("l.asc"), "EPSG:32632");
  const RasterFrame frame{
      {500007.0, 5201800.0 - 11.0, 30.0, 30.0}, 59, 59, normalize_crs("EPSG:32632")};
  const Raster<float> shifted = warp_rasters({source}, frame, silent_progress());
  for (int x = 0; x < 29; ++x) ASSERT_EQ(shifted.cells(x, 30), 500.F) << x;
}

TEST_F(RasterIo, SameBitsForAnyThreads) {
  const auto value = [](int x, int y) {
    return std::to_string(1000.0 + 300.0 * std::sin(0.05 * x) * std::cos(0.04 * y));
  };
  write_ascii("g.asc", 700, 600, 11.0, 47.0, 1.0 / 3600.0, value);
  const RasterSource source = source_of(path("g.asc"), "EPSG:4326");
  const RasterFrame frame = choose_frame({source}, "", 0.0, {});
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return warp_rasters({source}, frame, silent_progress());
  };
  const Raster<float> one = run(1);
  const Raster<float> two = run(2);
  ASSERT_TRUE(one.cells.same_size(two.cells));
  for (std::size_t i = 0; i < one.cells.size(); ++i)
    ASSERT_TRUE(one.cells[i] == two.cells[i] ||
                (std::isnan(one.cells[i]) && std::isnan(two.cells[i])));
}

TEST_F(RasterIo, CodesAreNeverBlended) {
  write_ascii("c.asc", 200, 150, 11.0, 47.0, 1.0 / 3600.0,
              [](int x, int y) { return (x / 7 + y / 5) % 2 == 0 ? "11" : "95"; });
  const RasterSource source = source_of(path("c.asc"), "EPSG:4326");
  const RasterFrame frame = choose_frame({source}, "", 0.0, {});
  const Raster<std::int32_t> codes = warp_codes({source}, frame, silent_progress());
  const PointTransform to_degrees(frame.crs, "EPSG:4326");
  std::size_t known = 0;
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const std::int32_t code = codes.cells(x, y);
      ASSERT_TRUE(code == -1 || code == 11 || code == 95);
      if (code < 0) continue;
      ++known;
      const glm::dvec2 p = frame.transform.to_crs(x, y);
      const glm::dvec2 degrees = to_degrees.apply(p);
      const double column = (degrees.x - 11.0) * 3600.0;
      const double row = 150.0 - (degrees.y - 47.0) * 3600.0;
      const auto close = [](double c) { return std::abs(c - std::round(c)) < 2e-3; };
      if (close(column) || close(row)) continue;
      const bool even = (static_cast<int>(column) / 7 + static_cast<int>(row) / 5) % 2 == 0;
      ASSERT_EQ(code, even ? 11 : 95) << x << ' ' << y;
    }
  EXPECT_GT(known, 25000U);
}

TEST_F(RasterIo, KeepsNoMoreBlocksThanASixteenthOfTheMemory) {
  setenv("BELVEDERE_MEMORY_MIB", "2048", 1);
  EXPECT_EQ(raster_cache_bytes(), std::uint64_t{128} << 20);
  setenv("BELVEDERE_MEMORY_MIB", "512", 1);
  EXPECT_EQ(raster_cache_bytes(), std::uint64_t{32} << 20) << "a budget that shrinks is heard";
  setenv("BELVEDERE_MEMORY_MIB", "64", 1);
  EXPECT_EQ(raster_cache_bytes(), std::uint64_t{16} << 20) << "but some rows of blocks must fit";
}

using testing::AllOf;

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
  for (const auto [x, y] : test::cells(6, 5))
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
