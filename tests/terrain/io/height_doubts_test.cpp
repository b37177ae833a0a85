#include "terrain/io/height_doubts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "terrain/io/dem.h"
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

TEST_F(HeightDoubts, HeightsOfNoGroundAreNotedWithTheKeysThatHelp) {
  const auto notes_of = [&](const std::string& odd) {
    write_ascii("f.asc", 20, 20, 500000, 5200000, 30,
                [&](int x, int y) { return x == 3 && y == 4 ? odd : "1200"; });
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
  EXPECT_THAT(picture.what(), AllOf(HasSubstr("colour picture"), HasSubstr("Terrarium")));
  EXPECT_THAT(refused(colours({"Palette"}, {7})).what(), HasSubstr("palette"));
  KeptNotes notes;
  read_dem(colours({"Gray"}, {120}), notes);
  EXPECT_THAT(notes.text, HasSubstr("8 bits"));
}

}  // namespace
}  // namespace belvedere
