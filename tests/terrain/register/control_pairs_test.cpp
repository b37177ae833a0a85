#include "terrain/register/control_pairs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "base/error.h"
#include "terrain/io/crs.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

using ::testing::HasSubstr;

const std::string header = "x_px,y_px,lon,lat,name,sure\n";

// 12 km around 11.29 E 47.36 N; the altitude is 1000 m and 0.1 m more a metre to the east.
const Dem& tilted_dem() {
  static const Dem dem = [] {
    Dem made = make_dem({test::grid_of(41, 41, [](int x, int) { return 1000.0 + 30.0 * x; }),
                         {666000.0, 5254000.0, 300.0, 300.0},
                         normalize_crs("EPSG:32632")});
    made.filled = Grid<std::uint8_t>(41, 41);
    for (int y = 0; y < 41; ++y) made.filled(40, y) = made.filled(39, y) = 1;
    return made;
  }();
  return dem;
}

std::string lonlat_of(glm::dvec2 position) {
  const glm::dvec2 at = transform_point(tilted_dem().crs, "EPSG:4326", position);
  return std::to_string(at.x) + "," + std::to_string(at.y);
}

// Row i: 1 km farther to the east.
std::string row_of(int i, const std::string& rest = "") {
  return std::to_string(100 + i) + "," + std::to_string(50 + i) + "," +
         lonlat_of({667000.0 + 1000.0 * i, 5248000.0}) + "," + "place " + std::to_string(i) + "," +
         rest + "\n";
}

std::string rows(int count) {
  std::string out;
  for (int i = 0; i < count; ++i) out += row_of(i);
  return out;
}

std::vector<ControlPair> read(const std::string& text) {
  const test::Folder folder;
  const std::string path = folder / "pairs.csv";
  test::write_bytes(path, text);
  return read_control_pairs(path, {1200, 550}, tilted_dem());
}

std::string refusal(const std::string& text) {
  return test::usage_error([&] { read(text); });
}

TEST(ControlPairs, HaveTheirPlaceAndTheAltitudeOfTheDem) {
  const std::vector<ControlPair> pairs = read(header + rows(8) + row_of(8, "1") + row_of(9, "0"));
  ASSERT_EQ(pairs.size(), 10U);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double n = static_cast<double>(i);
    EXPECT_EQ(pairs[i].pixel, glm::dvec2(100.0 + n, 50.0 + n));
    EXPECT_NEAR(pairs[i].position.x, 667000.0 + 1000.0 * n, 0.2);
    EXPECT_NEAR(pairs[i].position.y, 5248000.0, 0.2);
    EXPECT_NEAR(pairs[i].altitude_m, 1000.0 + 0.1 * (850.0 + 1000.0 * n), 0.05);
    EXPECT_EQ(pairs[i].name, "place " + std::to_string(i));
    EXPECT_EQ(pairs[i].sure, i == 8);
    EXPECT_EQ(pairs[i].line, static_cast<int>(i) + 2);
  }
}

TEST(ControlPairs, ColumnsMayStandInAnyOrderAndSureMayBeMissing) {
  std::string text = "name;lat;lon;y_px;x_px\n";
  for (int i = 0; i < 8; ++i) {
    const std::string at = lonlat_of({667000.0 + 1000.0 * i, 5248000.0});
    text += "n;" + at.substr(at.find(',') + 1) + ";" + at.substr(0, at.find(',')) + ";7.5;" +
            std::to_string(i) + "\n";
  }
  const std::vector<ControlPair> pairs = read(text);
  ASSERT_EQ(pairs.size(), 8U);
  EXPECT_EQ(pairs[3].pixel, glm::dvec2(3.0, 7.5));
  EXPECT_NEAR(pairs[3].position.x, 670000.0, 0.2);
  EXPECT_FALSE(pairs[3].sure);
}

TEST(ControlPairs, FaultsNameLineAndColumn) {
  EXPECT_THAT(refusal("x_px,y_px,lon,lat\n"), HasSubstr("pairs.csv:1: no column name"));
  const auto fault = [](const std::string& row) { return refusal(header + rows(8) + row); };
  const std::string here = lonlat_of({670000.0, 5250000.0});
  EXPECT_THAT(fault("abc,5," + here + ",n,\n"), HasSubstr("pairs.csv:10: x_px is \"abc\""));
  EXPECT_THAT(fault("1,5.5.5," + here + ",n,\n"), HasSubstr("pairs.csv:10: y_px is \"5.5.5\""));
  EXPECT_THAT(fault("1200.5,5," + here + ",n,\n"), HasSubstr("x_px is \"1200.5\""));
  EXPECT_THAT(fault("1,551," + here + ",n,\n"), HasSubstr("0 … 550"));
  EXPECT_THAT(fault("1,5,nan,47.3,n,\n"), HasSubstr("lon is \"nan\""));
  EXPECT_THAT(fault("1,5,11.3,91,n,\n"), HasSubstr("lat is \"91\""));
  EXPECT_THAT(fault("1,5,47.36,11.29,n,\n"), HasSubstr("lon is 47.36, which lies outside the DEM"));
  EXPECT_THAT(fault("1,5," + lonlat_of({677900.0, 5250000.0}) + ",n,\n"), HasSubstr("no data"));
  EXPECT_THAT(fault("1,5," + here + ",n,yes\n"), HasSubstr("pairs.csv:10: sure is \"yes\""));
  EXPECT_THAT(fault(row_of(3)), HasSubstr("as in line 5: the same pair"));
  EXPECT_THAT(refusal(header + rows(7)), HasSubstr("7 pairs"));
}

TEST(ControlPairs, AreWrittenAsTheyAreRead) {
  const std::vector<ControlPair> pairs = [] {
    std::vector<ControlPair> out =
        parse_control_pairs(header + rows(3), "pairs.csv", {1200, 550}, tilted_dem(),
                            {.min_pairs = 0, .other_columns = false});
    out[0].pixel = {0.1, 549.9};
    out[0].name = "Spitze, \"große\"";
    out[1].name = " ; ";
    out[2].sure = true;
    return out;
  }();
  const std::string text = control_pairs_text(pairs);
  EXPECT_THAT(text, HasSubstr(header));
  const std::vector<ControlPair> again =
      parse_control_pairs(text, "pairs.csv", {1200, 550}, tilted_dem(), {.min_pairs = 3});
  ASSERT_EQ(again.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(again[i].pixel, pairs[i].pixel);
    EXPECT_EQ(again[i].lonlat, pairs[i].lonlat);
    EXPECT_EQ(again[i].position, pairs[i].position);
    EXPECT_EQ(again[i].name, pairs[i].name);
    EXPECT_EQ(again[i].sure, i == 2);
  }
  EXPECT_EQ(control_pairs_text(again), text);
  EXPECT_EQ(control_pairs_text({}), header);
}

TEST(ControlPairs, ColumnsThatWouldBeLostAreRefusedBeforeWriting) {
  const std::string text = "x_px,y_px,lon,lat,name,who\n";
  EXPECT_TRUE(parse_control_pairs(text, "p", {1200, 550}, tilted_dem(), {.min_pairs = 0}).empty());
  EXPECT_THAT(test::usage_error([&] {
                parse_control_pairs(text, "p", {1200, 550}, tilted_dem(),
                                    {.min_pairs = 0, .other_columns = false});
              }),
              HasSubstr("p:1: has a column who"));
}

TEST(HighestCells, KeepSummits) {
  Dem dem = make_dem({test::grid_of(7, 6, [](int x, int y) { return x == 3 && y == 2 ? 900 : x; }),
                      {0.0, 600.0, 100.0, 100.0},
                      normalize_crs("EPSG:32632")});
  EXPECT_EQ(highest_cells(dem, 42).width(), 7) << "they fit";
  const Dem made = highest_cells(dem, 12);
  EXPECT_EQ(made.width(), 3) << "a column is left over";
  EXPECT_EQ(made.height(), 3);
  EXPECT_EQ(made.cell_m(), 200.0);
  EXPECT_EQ(made.altitude_m(1, 1), 900.F);
  EXPECT_EQ(made.altitude_m(2, 0), 5.F);
  EXPECT_EQ(made.transform.to_crs(0.0, 0.0), glm::dvec2(100.0, 500.0));
  dem.filled = Grid<std::uint8_t>(7, 6);
  dem.filled(0, 0) = 1;
  EXPECT_EQ(highest_cells(dem, 12).filled(0, 0), 0) << "only in part";
  dem.filled(1, 0) = dem.filled(0, 1) = dem.filled(1, 1) = 1;
  EXPECT_EQ(highest_cells(dem, 12).filled(0, 0), 1);
}

}  // namespace
}  // namespace belvedere
