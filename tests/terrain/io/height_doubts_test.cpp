#include "terrain/io/height_doubts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "terrain/io/dem.h"
#include "terrain/io/dem_levels.h"
#include "terrain/io/raster_io.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;

struct KeptNotes : Progress {
  std::string text;
  void note(std::string_view line) override { text += std::string(line) + "\n"; }
};

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
    KeptNotes notes;
    const Dem dem = read_dem(dem_of("f.asc"), notes);
    EXPECT_EQ(dem.filled(12, 20), 1) << value;
    EXPECT_NEAR(dem.altitude_m(12, 20), 1012.F, 3.F) << value;
    EXPECT_THAT(notes.text,
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
    KeptNotes notes;
    const Dem dem = read_dem(dem_of("w.vrt"), notes);
    EXPECT_EQ(dem.filled(12, 20), 1) << c.type;
    EXPECT_EQ(dem.filled(5, 20), 0) << c.type;
    EXPECT_NEAR(dem.altitude_m(12, 20), 112.F, 3.F) << c.type;
    EXPECT_THAT(notes.text, HasSubstr(std::string("nodata value ") + c.nodata)) << c.type;
    const RasterSource codes = source_of(path("w.vrt"), "EPSG:32632");
    EXPECT_EQ(read_codes(codes).cells(12, 20), -1) << c.type;
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
  KeptNotes notes;
  EXPECT_EQ(read_dem(dem_of("s.vrt"), notes).altitude_m(5, 9), -6.F);
  EXPECT_EQ(notes.text.find("0…255"), std::string::npos);
}

TEST_F(HeightDoubts, HeightsOfNoGroundAreNotedWithTheKeysThatHelp) {
  const auto notes_of = [&](const std::string& odd) {
    write_ascii("f.asc", 20, 20, 500000, 5200000, 30,
                [&](int x, int y) { return x / 3 == 1 && y / 3 == 2 ? odd : "1200"; });
    KeptNotes notes;
    read_dem(dem_of("f.asc"), notes);
    return notes.text;
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
    KeptNotes notes;
    check_height_sources(parameters.sources, notes);
    return notes.text;
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
  KeptNotes notes;
  read_dem(colours({"Gray"}, {120}), notes);
  EXPECT_THAT(notes.text, HasSubstr("8 bits"));
}

// A clipped DEM: 0 outside a circle, slopes of 900…1500 m inside.
TEST_F(HeightDoubts, ZeroOutsideAnOutlineIsVoid) {
  const auto height = [](int x, int y) { return 900 + 10 * x + 5 * y; };
  const auto inside = [](int x, int y) { return std::hypot(x - 20, y - 20) < 18; };
  write_ascii("f.asc", 40, 40, 500000, 5200000, 30,
              [&](int x, int y) { return std::to_string(inside(x, y) ? height(x, y) : 0); });
  DemParameters parameters = dem_of("f.asc");
  parameters.max_void_share = 0.9;
  KeptNotes notes;
  const Dem dem = read_dem(parameters, notes);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      ASSERT_EQ(dem.filled(x, y) != 0, !inside(x, y)) << x << ' ' << y;
      ASSERT_GT(dem.altitude_m(x, y), 900.F) << x << ' ' << y;
    }
  EXPECT_THAT(notes.text, AllOf(HasSubstr("cells of 0 are taken as void"), HasSubstr("`nodata`")));
  // Said: they are heights.
  parameters.sources[0].nodata = -1.0;
  EXPECT_EQ(read_dem(parameters, silent_progress()).altitude_m(0, 0), 0.F);
}

// The sea is 0 too, but a coast begins near it, also where some of it is cliff.
TEST_F(HeightDoubts, ZeroBesideACoastIsSea) {
  write_ascii("f.asc", 60, 40, 500000, 5200000, 30, [](int x, int y) {
    return std::to_string(x < 20 ? 0 : y % 3 == 0 ? 120 + x : (x - 19) * 12);
  });
  KeptNotes notes;
  const Dem dem = read_dem(dem_of("f.asc"), notes);
  EXPECT_EQ(notes.text, "");
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
    KeptNotes notes;
    const Dem dem = read_dem(dem_of("f.asc"), notes);
    EXPECT_EQ(dem.filled(12, 7), 1);
    EXPECT_EQ(dem.filled(13, 7), 0);
    EXPECT_NEAR(dem.altitude_m(12, 7), height(12, 7), 1.0);
    EXPECT_THAT(notes.text, AllOf(HasSubstr("1 single cells"), HasSubstr("column 12, row 7")));
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
  KeptNotes whole_notes, notes;
  const Dem dem = read_dem(parameters, whole_notes);
  const RasterFrame frame = choose_frame(parameters.sources, "", 0.0, {});
  DemLevels levels(parameters, frame, 1, 0.0, notes);
  for (const char* said : {"cells of 0 are", "1 single cells", "cells of -99999"}) {
    EXPECT_THAT(whole_notes.text, HasSubstr(said));
    EXPECT_THAT(notes.text, HasSubstr(said));
  }
  const Dem whole = levels.whole();
  for (const float z : whole.altitude_m) ASSERT_NEAR(z, 1200.F, 0.5F);
  const Dem window = levels.window(0, {45, 5, 55, 15}, whole);
  EXPECT_EQ(window.filled(5, 4), 1);
  EXPECT_EQ(dem.filled(50, 9), 1);
}

TEST_F(HeightDoubts, AFileReadAloneIsJudgedAlike) {
  write_ascii("f.asc", 30, 30, 500000, 5200000, 30,
              [](int x, int y) { return std::string(x == 9 && y == 9 ? "5000" : "1200"); });
  RasterSource source;
  source.path = path("f.asc");
  KeptNotes notes;
  const Dem dem = read_own_dem(source, notes);
  EXPECT_EQ(dem.crs, "");
  EXPECT_EQ(dem.filled(9, 9), 1);
  EXPECT_EQ(dem.altitude_m(9, 9), 1200.F);
  EXPECT_THAT(notes.text, HasSubstr("1 single cells"));
}

}  // namespace
}  // namespace belvedere
