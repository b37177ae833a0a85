#include "terrain/climate/stations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/files.h"
#include "tests/notes.h"
#include "tests/paths.h"

namespace belvedere {
namespace {

using test::Notes;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

std::string months_header() {
  std::string text;
  for (int m = 1; m <= 12; ++m) text += ",t_" + std::to_string(m);
  return text;
}

TEST(Stations, ATableOfMonthsAndRain) {
  const test::Folder folder;
  std::string text = "name,east,north,altitude" + months_header() + ",rain\n";
  for (int i = 0; i < 8; ++i) {
    text += "S" + std::to_string(i) + ",100,200," + std::to_string(500 + 100 * i);
    for (int m = 1; m <= 12; ++m) text += "," + std::to_string(m);
    text += i == 3 ? ",\n" : ",900\n";
  }
  Notes notes;
  const StationTable table = read_stations(folder.write("s.csv", text), "", notes);
  ASSERT_EQ(table.stations.size(), 8U);
  EXPECT_EQ(table.stations[2].name, "S2");
  EXPECT_EQ(table.stations[2].altitude_m, 700.0);
  EXPECT_EQ(table.stations[2].temperature_c[11], 12.0);
  EXPECT_EQ(table.stations[2].temperature_year_c, 6.5);
  EXPECT_TRUE(std::isnan(table.stations[3].rain_mm));
  EXPECT_TRUE(table.has_months() && table.has_rain() && table.has_temperature());
  EXPECT_THAT(notes.text(), IsEmpty());
}

TEST(Stations, MeansOfTheYearAreEnoughAndFewStationsAreNoted) {
  const test::Folder folder;
  Notes notes;
  const StationTable table = read_stations(
      folder.write("s.csv", "lon;lat;elevation;t_year\n11;47;600;8.5\n11.1;47.1;2000;0\n"),
      "EPSG:32632", notes);
  EXPECT_EQ(table.stations[1].temperature_year_c, 0.0);
  EXPECT_FALSE(table.has_months());
  EXPECT_FALSE(table.has_rain());
  EXPECT_NEAR(table.stations[0].position.x, 652000.0, 2000.0);
  EXPECT_THAT(notes.text(), AllOf(HasSubstr("2 stations"), HasSubstr("at least 8")));
}

TEST(Stations, MissingColumnsAreNamed) {
  const test::Folder folder;
  const auto message = [&](const std::string& text) {
    const std::string path = folder.write("s.csv", text);
    return test::message_of(ErrorKind::usage, [&] { read_stations(path, "", silent_progress()); });
  };
  EXPECT_THAT(message("east,north,t_year\n1,2,3\n"),
              AllOf(HasSubstr("no column altitude_m"), HasSubstr("s.csv")));
  EXPECT_THAT(message("east,north,altitude\n1,2,3\n"), HasSubstr("t_year"));
  EXPECT_THAT(message("east,north,altitude,t_1,t_2,t_4\n1,2,3,4,5,6\n"),
              AllOf(HasSubstr("t_3, t_5"), HasSubstr("all of t_1")));
  EXPECT_THAT(message("altitude,t_year\n1,2\n"), HasSubstr("lon and lat, or east and north"));
  EXPECT_THAT(message("east,north,altitude,t_year\n1,2,600,warm\n"),
              AllOf(HasSubstr("s.csv:2"), HasSubstr("warm"), HasSubstr("°C")));
  EXPECT_THAT(message("east,north,altitude,t_year\n1,2,,5\n"), HasSubstr("no altitude"));
  EXPECT_THAT(message("east,north,altitude,t_year\n1,2,60000,5\n"), HasSubstr("60000"));
}

TEST(Stations, EmptyAndBrokenFiles) {
  const test::Folder folder;
  const auto message = [&](const std::string& name, const std::string& text) {
    const std::string path = folder.write(name, text);
    return test::message_of(ErrorKind::input,
                            [&] { read_stations(path, "EPSG:32632", silent_progress()); });
  };
  EXPECT_THAT(message("s.csv", "east,north,altitude,t_year\n"), HasSubstr("no station"));
  EXPECT_THAT(message("s.nc", "this is no netCDF"), HasSubstr("not a netCDF file"));
  EXPECT_THAT(
      test::message_of(ErrorKind::input,
                       [&] { read_stations(folder / "none.nc", "EPSG:32632", silent_progress()); }),
      HasSubstr("file not found"));
}

TEST(Stations, AHistoryOfTheClimateGivesItsLastThirtyYears) {
  const std::string path = test::data_folder() + "/oetztal/HISTALP_oetztal.nc";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs " << path;
  const StationTable table = read_stations(path, "EPSG:4326", silent_progress());
  ASSERT_EQ(table.stations.size(), 49U);
  for (const Station& station : table.stations) {
    EXPECT_GT(station.position.x, 9.0);
    EXPECT_LT(station.position.x, 13.0);
    EXPECT_GT(station.temperature_c[6], station.temperature_c[0] + 10.0);
    EXPECT_GT(station.rain_mm, 500.0);
    EXPECT_LT(station.rain_mm, 2000.0);
  }
  EXPECT_THAT(
      test::message_of(ErrorKind::usage, [&] { read_stations(path, "", silent_progress()); }),
      HasSubstr("terrain has no CRS"));
}

}  // namespace
}  // namespace belvedere
