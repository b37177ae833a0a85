#include "terrain/io/dem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "terrain/io/dem_levels.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/notes.h"
#include "tests/paths.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

class DemFiles : public RasterFiles {};

Raster<float> make_slope(int width, int height) {
  Raster<float> raster{
      Grid<float>(width, height), {500000.0, 5200000.0, 30.0, 30.0}, normalize_crs("EPSG:32632")};
  for (const auto [x, y] : test::cells(width, height))
    raster.cells(x, y) = 1000.F + 5.F * static_cast<float>(x) - 3.F * static_cast<float>(y);
  return raster;
}

void cut_disc(Grid<float>& cells, double cx, double cy, double radius) {
  for (const auto [x, y] : test::cells(cells))
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
  for (const auto [x, y] : test::cells(200, 200))
    raster.cells(x, y) += 200.F * static_cast<float>(std::sin(0.05 * x) * std::cos(0.07 * y));
  double steepest = 0.0;
  for (const auto [x, y] : test::cells({1, 0, 200, 200}))
    steepest = std::max(steepest,
                        std::abs(static_cast<double>(raster.cells(x, y)) - raster.cells(x - 1, y)));
  cut_disc(raster.cells, 90, 100, 45);
  for (int y = 0; y < 200; ++y)  // and a slanted rim, as reprojected tiles have
    for (int x = 0; x < 4 + y / 20; ++x) raster.cells(x, y) = NAN;
  const Dem dem = make_dem(raster);
  for (const auto [x, y] : test::cells({1, 0, 200, 200})) {
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
  const auto many = make_dem(raster).altitude_m;
  const ThreadLimit one(1);
  EXPECT_EQ(make_dem(raster).altitude_m, many);
}

TEST_F(DemFiles, ReadsConvertsFillsAndSaysSo) {
  test::Notes notes;
  write_ascii("f.asc", 50, 40, 500000, 5200000, 30,
              [](int x, int y) { return x == 20 && y < 10 ? "-9999" : std::to_string(3000 + x); });
  DemParameters parameters;
  parameters.sources.resize(1);
  parameters.sources[0].path = path("f.asc");
  EXPECT_THAT(error_of([&] { read_dem(parameters, notes); }).what(), HasSubstr("`crs`"));
  parameters.sources[0].crs = "EPSG:32632";
  parameters.sources[0].unit_to_m = 0.3048;
  const Dem dem = read_dem(parameters, notes);
  EXPECT_THAT(notes.text(), HasSubstr("10 void cells"));
  EXPECT_FLOAT_EQ(dem.altitude_m(10, 5), 3010.F * 0.3048F);
  EXPECT_EQ(dem.filled(20, 9), 1);
  EXPECT_EQ(dem.filled(20, 10), 0);
  EXPECT_NEAR(dem.altitude_m(20, 5), 3020.F * 0.3048F, 0.5);
  EXPECT_EQ(dem.cell_m(), 30.0);

  parameters.max_void_share = 0.004;
  EXPECT_THAT(test::input_error([&] { read_dem(parameters, notes); }), HasSubstr("0.5 %"));
  parameters.cell_m = 1e6;
  EXPECT_EQ(error_of([&] { read_dem(parameters, notes); }).kind(), ErrorKind::usage);
}

// Coordinates in another system than the given one: the ground is read, with a note on its
// position.
TEST_F(DemFiles, APlaceFarFromWhereItsSystemIsUsedIsDoubted) {
  const auto notes_of = [&](double east, double north, const char* crs) {
    write_ascii("f.asc", 50, 40, east, north, 30,
                [](int x, int) { return std::to_string(1000 + x); });
    DemParameters parameters;
    parameters.sources.resize(1);
    parameters.sources[0].path = path("f.asc");
    parameters.sources[0].crs = crs;
    test::Notes notes;
    read_dem(parameters, notes);
    return notes.text();
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

using testing::AllOf;

class HeightDoubts : public RasterFiles {
 protected:
  DemParameters dem_of(const std::string& name, const std::string& crs = "EPSG:32632") const {
    DemParameters parameters;
    parameters.sources.resize(1);
    parameters.sources[0].path = path(name);
    parameters.sources[0].crs = crs;
    return parameters;
  }
  // NAME.vrt of one band of `type` and `nodata` over NAME.asc.
  void write_band(const std::string& name, const std::string& type, const std::string& nodata,
                  const std::function<std::string(int, int)>& value,
                  const std::string& metadata = "") const {
    write_ascii(name + ".asc", 40, 40, 500000, 5200000, 30, value);
    write_text(name + ".vrt",
               "<VRTDataset rasterXSize=\"40\" rasterYSize=\"40\"><GeoTransform>500000,30,0,"
               "5201200,0,-30</GeoTransform><VRTRasterBand dataType=\"" +
                   type + "\" band=\"1\">" + metadata + "<NoDataValue>" + nodata +
                   "</NoDataValue><SimpleSource><SourceFilename relativeToVRT=\"1\">" + name +
                   ".asc</SourceFilename><SourceBand>1</SourceBand></SimpleSource>"
                   "</VRTRasterBand></VRTDataset>");
  }
  // A VRT of 8-bit bands with these colours over ASCII grids of `values`.
  DemParameters colours(const std::vector<std::string>& meanings,
                        const std::vector<int>& values) const {
    std::string bands;
    for (std::size_t i = 0; i < meanings.size(); ++i) {
      const std::string file = "c" + std::to_string(i) + ".asc";
      write_ascii(file, 20, 20, 500000, 5200000, 30,
                  [&](int x, int) { return std::to_string(values[i] + (i == 2 ? x % 2 : 0)); });
      bands += "<VRTRasterBand dataType=\"Byte\" band=\"" + std::to_string(i + 1) +
               "\"><ColorInterp>" + meanings[i] +
               "</ColorInterp><SimpleSource><SourceFilename relativeToVRT=\"1\">" + file +
               "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand>";
    }
    write_text("c.vrt",
               "<VRTDataset rasterXSize=\"20\" rasterYSize=\"20\"><GeoTransform>500000,30,0,"
               "5200600,0,-30</GeoTransform>" +
                   bands + "</VRTDataset>");
    return dem_of("c.vrt");
  }
};

// Common placeholder numbers for unknown heights are voids even if no header declares them.
TEST_F(HeightDoubts, NumbersOfUnknownHeightsAreVoids) {
  for (const char* value : {"-99999", "-999999", "65535", "99999", "-32767"}) {
    write_ascii("f.asc", 40, 40, 500000, 5200000, 30, [&](int x, int y) {
      return x > 10 && x < 15 && y > 10 ? std::string(value) : std::to_string(1000 + x);
    });
    test::Notes notes;
    const Dem dem = read_dem(dem_of("f.asc"), notes);
    EXPECT_EQ(dem.filled(12, 20), 1) << value;
    EXPECT_NEAR(dem.altitude_m(12, 20), 1012.F, 3.F) << value;
    EXPECT_THAT(notes.text(),
                AllOf(HasSubstr(std::string("cells of ") + value), HasSubstr("`nodata`")));
  }
  // Declared as another value: small numbers may then be heights, large ones never.
  write_ascii(
      "g.asc", 20, 20, 500000, 5200000, 30,
      [](int x, int) {
        return std::string(x == 3 ? "-99999" : x == 5 ? "-9999" : "700");
      },
      "-9999");
  const Dem dem = read_dem(dem_of("g.asc"), silent_progress());
  EXPECT_EQ(dem.filled(3, 3), 1);
  EXPECT_EQ(dem.filled(5, 3), 1);
  EXPECT_EQ(dem.filled(8, 3), 0);
}

// A nodata value outside the range of the cells becomes another number in them:
// 55537 = 2^16 - 9999.
TEST_F(HeightDoubts, NodataThatTheCellsCannotHoldIsVoid) {
  struct Case {
    const char* type;
    const char* nodata;
    std::string stored;
  };
  for (const Case& c : {Case{"UInt16", "-9999", "55537"}, Case{"Byte", "-9", "247"},
                        Case{"UInt32", "-9999", "4294957297"}, Case{"Int16", "55537", "-9999"}}) {
    write_band("w", c.type, c.nodata, [&](int x, int y) {
      // With a point: GDAL reads whole numbers of an ASCII grid in 32 bits with a sign.
      return (x > 10 && x < 15 && y > 10 ? c.stored : std::to_string(100 + x)) + ".0";
    });
    test::Notes notes;
    const Dem dem = read_dem(dem_of("w.vrt"), notes);
    EXPECT_EQ(dem.filled(12, 20), 1) << c.type;
    EXPECT_EQ(dem.filled(5, 20), 0) << c.type;
    EXPECT_NEAR(dem.altitude_m(12, 20), 112.F, 3.F) << c.type;
    EXPECT_THAT(notes.text(), HasSubstr(std::string("nodata value ") + c.nodata)) << c.type;
    EXPECT_EQ(read_codes(source_of(path("w.vrt"), "EPSG:32632")).cells(12, 20), -1) << c.type;
  }
  // More than one range away, it is no number of the cells.
  write_band("w", "Byte", "-9999",
             [](int x, int) { return std::to_string(x == 7 ? 241 : 100 + x); });
  EXPECT_EQ(read_dem(dem_of("w.vrt"), silent_progress()).filled(7, 20), 0);
}

// GDAL before 3.7 marks signed bytes in the metadata and reads them as 0…255.
TEST_F(HeightDoubts, SignedBytesHaveASign) {
  write_band(
      "s", "Byte", "-1",
      [](int x, int y) {
        return std::to_string(x == 7 ? 255 : y == 9 ? 250 : x);
      },
      "<Metadata domain=\"IMAGE_STRUCTURE\"><MDI key=\"PIXELTYPE\">SIGNEDBYTE</MDI></Metadata>");
  const RasterSource source = source_of(path("s.vrt"), "EPSG:32632");
  const Raster<float> read = read_raster(source);
  EXPECT_EQ(read.cells(5, 9), -6.F);
  EXPECT_EQ(read.cells(5, 5), 5.F);
  EXPECT_TRUE(std::isnan(read.cells(7, 5)));
  EXPECT_EQ(read_codes(source).cells(5, 9), -1) << "no code is negative";
  EXPECT_EQ(read_codes(source).cells(5, 5), 5);
  test::Notes notes;
  EXPECT_EQ(read_dem(dem_of("s.vrt"), notes).altitude_m(5, 9), -6.F);
  EXPECT_EQ(notes.text().find("0…255"), std::string::npos);
}

TEST_F(HeightDoubts, HeightsOfNoGroundAreNotedWithTheKeysThatHelp) {
  const auto notes_of = [&](const std::string& odd) {
    write_ascii("f.asc", 20, 20, 500000, 5200000, 30,
                [&](int x, int y) { return x / 3 == 1 && y / 3 == 2 ? odd : "1200"; });
    test::Notes notes;
    read_dem(dem_of("f.asc"), notes);
    return notes.text();
  };
  EXPECT_EQ(notes_of("-10900"), "") << "the Challenger Deep";
  EXPECT_EQ(notes_of("8849"), "");
  EXPECT_THAT(notes_of("-12345"), AllOf(HasSubstr("deepest sea"), HasSubstr("`lowest_m`")));
  EXPECT_THAT(notes_of("14505"), AllOf(HasSubstr("highest mountain"), HasSubstr("`unit`")));
}

TEST_F(HeightDoubts, FeetAreAskedForWhereTheMapCountsInFeet) {
  write_ascii("f.asc", 20, 20, 3000000, 1000000, 100,
              [](int x, int) { return std::to_string(9000 + x); });
  const auto notes_of = [&](const DemParameters& parameters) {
    test::Notes notes;
    check_height_sources(parameters.sources, notes);
    return notes.text();
  };
  DemParameters parameters = dem_of("f.asc", "EPSG:2232");  // Colorado Central, survey feet
  EXPECT_THAT(notes_of(parameters), AllOf(HasSubstr("is in feet"), HasSubstr("\"us-ft\"")));
  parameters.sources[0].unit_to_m = 1.0;
  EXPECT_EQ(notes_of(parameters), "") << "said";
  EXPECT_EQ(notes_of(dem_of("f.asc", "EPSG:32613")).find("feet"), std::string::npos);
}

TEST_F(HeightDoubts, ColoursAreNoHeights) {
  const auto refused = [&](const DemParameters& parameters) {
    return error_of([&] { read_dem(parameters, silent_progress()); });
  };
  const Error picture = refused(colours({"Red", "Green", "Blue"}, {120, 120, 120}));
  EXPECT_EQ(picture.kind(), ErrorKind::input);
  EXPECT_THAT(picture.what(), AllOf(HasSubstr("colour picture"), HasSubstr("terrarium")));
  EXPECT_THAT(refused(colours({"Palette"}, {7})).what(), HasSubstr("palette"));
  test::Notes notes;
  read_dem(colours({"Gray"}, {120}), notes);
  EXPECT_THAT(notes.text(), HasSubstr("8 bits"));
}

// A clipped DEM: 0 outside a circle, slopes of 900…1500 m inside.
TEST_F(HeightDoubts, ZeroOutsideAnOutlineIsVoid) {
  const auto height = [](int x, int y) { return 900 + 10 * x + 5 * y; };
  const auto inside = [](int x, int y) { return std::hypot(x - 20, y - 20) < 18; };
  write_ascii("f.asc", 40, 40, 500000, 5200000, 30,
              [&](int x, int y) { return std::to_string(inside(x, y) ? height(x, y) : 0); });
  DemParameters parameters = dem_of("f.asc");
  parameters.max_void_share = 0.9;
  test::Notes notes;
  const Dem dem = read_dem(parameters, notes);
  for (const auto [x, y] : test::cells(40, 40)) {
    ASSERT_EQ(dem.filled(x, y) != 0, !inside(x, y)) << x << ' ' << y;
    ASSERT_GT(dem.altitude_m(x, y), 900.F) << x << ' ' << y;
  }
  EXPECT_THAT(notes.text(),
              AllOf(HasSubstr("cells of 0 are taken as void"), HasSubstr("`nodata`")));
  // Said: they are heights.
  parameters.sources[0].nodata = -1.0;
  EXPECT_EQ(read_dem(parameters, silent_progress()).altitude_m(0, 0), 0.F);
}

// The sea is 0 too, but a coast begins near it, also where some of it is cliff.
TEST_F(HeightDoubts, ZeroBesideACoastIsSea) {
  write_ascii("f.asc", 60, 40, 500000, 5200000, 30, [](int x, int y) {
    return std::to_string(x < 20 ? 0 : y % 3 == 0 ? 120 + x : (x - 19) * 12);
  });
  test::Notes notes;
  const Dem dem = read_dem(dem_of("f.asc"), notes);
  EXPECT_EQ(notes.text(), "");
  EXPECT_EQ(dem.filled(3, 3), 0);
  EXPECT_EQ(dem.altitude_m(3, 3), 0.F);
}

TEST_F(HeightDoubts, SpikesOfSingleCellsAreVoid) {
  const auto height = [](int x, int y) { return 1000.0 + 20.0 * x + 10.0 * y; };
  const auto write = [&](double spike, int size) {
    write_ascii("f.asc", 40, 30, 500000, 5200000, 30, [&](int x, int y) {
      const bool odd = x >= 12 && x < 12 + size && y >= 7 && y < 7 + size;
      return std::to_string(height(x, y) + (odd ? spike : 0.0));
    });
  };
  for (const double spike : {700.0, -700.0}) {
    write(spike, 1);
    test::Notes notes;
    const Dem dem = read_dem(dem_of("f.asc"), notes);
    EXPECT_EQ(dem.filled(12, 7), 1);
    EXPECT_EQ(dem.filled(13, 7), 0);
    EXPECT_NEAR(dem.altitude_m(12, 7), height(12, 7), 1.0);
    EXPECT_THAT(notes.text(), AllOf(HasSubstr("1 single cells"), HasSubstr("column 12, row 7")));
  }
  // A mesa is no spike, and neither is what mountains have.
  write(700.0, 3);
  EXPECT_EQ(read_dem(dem_of("f.asc"), silent_progress()).filled(13, 8), 0);
  write(140.0, 1);
  EXPECT_EQ(read_dem(dem_of("f.asc"), silent_progress()).filled(12, 7), 0);
}

// Ground that is read in windows is judged like ground that is read whole, and says the same.
TEST_F(HeightDoubts, LargeGroundIsJudgedAlike) {
  write_ascii("f.asc", 80, 60, 500000, 5200000, 30, [](int x, int y) {
    return std::string(x < 20              ? "0"
                       : x == 50 && y == 9 ? "2400"
                       : x > 60 && y > 50  ? "-99999"
                                           : "1200");
  });
  DemParameters parameters = dem_of("f.asc");
  parameters.max_void_share = 0.9;
  test::Notes whole_notes, notes;
  const Dem dem = read_dem(parameters, whole_notes);
  const RasterFrame frame = choose_frame(parameters.sources, "", 0.0, {});
  DemLevels levels(parameters, frame, 1, 0.0, notes);
  for (const char* said : {"cells of 0 are", "1 single cells", "cells of -99999"}) {
    EXPECT_THAT(whole_notes.text(), HasSubstr(said));
    EXPECT_THAT(notes.text(), HasSubstr(said));
  }
  const Dem whole = levels.whole();
  for (const float z : whole.altitude_m) ASSERT_NEAR(z, 1200.F, 0.5F);
  EXPECT_EQ(levels.window(0, {45, 5, 55, 15}, whole).filled(5, 4), 1);
  EXPECT_EQ(dem.filled(50, 9), 1);
}

TEST_F(HeightDoubts, AFileReadAloneIsJudgedAlike) {
  write_ascii("f.asc", 30, 30, 500000, 5200000, 30,
              [](int x, int y) { return std::string(x == 9 && y == 9 ? "5000" : "1200"); });
  RasterSource source;
  source.path = path("f.asc");
  test::Notes notes;
  const Dem dem = read_own_dem(source, notes);
  EXPECT_EQ(dem.crs, "");
  EXPECT_EQ(dem.filled(9, 9), 1);
  EXPECT_EQ(dem.altitude_m(9, 9), 1200.F);
  EXPECT_THAT(notes.text(), HasSubstr("1 single cells"));
}

}  // namespace
}  // namespace belvedere
