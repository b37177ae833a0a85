#include "terrain/climate/stations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/random.h"
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

struct Synthetic {
  std::vector<double> altitude_m, temperature_c;
};
// T = 14 - 5.5 K/km from 300 to 3300 m, with .5 K noise; every tenth station is 6 K wrong, either
// way.
Synthetic make_stations(int count, int seed) {
  Synthetic out;
  for (int i = 0; i < count; ++i) {
    const auto key = static_cast<std::uint64_t>(seed);
    const double z = 300.0 + 3000.0 * random_uniform(key, i, 1);
    double t = 14.0 - 5.5e-3 * z + 0.5 * random_normal(key, i, 2);
    if (i % 10 == 3) t += random_uniform(key, i, 3) < 0.5 ? -6.0 : 6.0;
    out.altitude_m.push_back(z);
    out.temperature_c.push_back(t);
  }
  return out;
}

TEST(LapseRate, IsRecoveredThroughNoiseAndGrossErrors) {
  double square = 0.0;
  int within = 0;
  constexpr int draws = 200;
  for (int seed = 0; seed < draws; ++seed) {
    const Synthetic stations = make_stations(20, seed);
    const LapseRate rate = fit_lapse_rate(stations.altitude_m, stations.temperature_c, 200);
    square += std::pow(rate.k_per_km - 5.5, 2.0);
    if (rate.low_k_per_km <= 5.5 && 5.5 <= rate.high_k_per_km) ++within;
  }
  RecordProperty("rms", std::to_string(std::sqrt(square / draws)));
  EXPECT_LT(std::sqrt(square / draws), 0.2) << "K/km";
  EXPECT_GT(within, draws * 85 / 100) << "the range holds the truth nearly as often as it says";
}

TEST(LapseRate, ALineIsFoundExactlyAndUnknownValuesAreLeftOut) {
  std::vector<double> z;
  std::vector<double> t;
  for (int i = 0; i < 12; ++i) {
    z.push_back(300.0 + 211.0 * i);
    t.push_back(i == 5 ? std::numeric_limits<double>::quiet_NaN() : 10.0 - 6.5e-3 * z.back());
  }
  const LapseRate rate = fit_lapse_rate(z, t);
  EXPECT_EQ(rate.stations, 11);
  EXPECT_NEAR(rate.k_per_km, 6.5, 1e-9);
  EXPECT_NEAR(rate.sea_level_c, 10.0, 1e-9);
  EXPECT_NEAR(rate.left_out_k, 0.0, 1e-9);
  EXPECT_NEAR(rate.at(2000.0), -3.0, 1e-9);
  EXPECT_NEAR(rate.low_k_per_km, 6.5, 1e-9);
}

TEST(LapseRate, TellsWhereStationsTellNothing) {
  EXPECT_THAT(test::message_of(ErrorKind::input,
                               [] {
                                 fit_lapse_rate({100.0, 900.0}, {10.0, 5.0});
                               }),
              HasSubstr("at least 3 stations"));
  EXPECT_THAT(
      test::message_of(ErrorKind::input,
                       [] {
                         fit_lapse_rate({100.0, 110.0, 120.0, 130.0}, {10.0, 9.0, 8.0, 9.0});
                       }),
      HasSubstr("50 m"));
}

TEST(LapseRate, ManyStationsTakeNoMorePairs) {
  const Synthetic stations = make_stations(3000, 9);
  EXPECT_NEAR(fit_lapse_rate(stations.altitude_m, stations.temperature_c, 20).k_per_km, 5.5, 0.05);
}

TEST(LapseRate, TheOetztalIsAsItWasMeasured) {
  const std::string path = test::data_folder() + "/oetztal/HISTALP_oetztal.nc";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "needs " << path;
  const StationTable table = read_stations(path, "EPSG:32632", silent_progress());
  ASSERT_EQ(table.stations.size(), 49U);
  EXPECT_EQ(table.period, "1984-10 … 2014-09");
  std::vector<double> z;
  for (const Station& station : table.stations) z.push_back(station.altitude_m);
  const auto rate_of = [&](int month) {
    std::vector<double> t;
    for (const Station& station : table.stations)
      t.push_back(month < 0 ? station.temperature_year_c
                            : station.temperature_c[static_cast<std::size_t>(month)]);
    return fit_lapse_rate(z, t);
  };
  const LapseRate year = rate_of(-1);
  EXPECT_NEAR(year.k_per_km, 5.74, 0.005);
  EXPECT_NEAR(year.left_out_k, 0.34, 0.02);
  EXPECT_LT(year.low_k_per_km, 5.65);
  EXPECT_GT(year.high_k_per_km, 5.85);
  EXPECT_NEAR(rate_of(0).k_per_km, 4.2, 0.2) << "January: cold air lies in valleys";
  EXPECT_NEAR(rate_of(5).k_per_km, 6.8, 0.2) << "June";
}

}  // namespace

}  // namespace belvedere
