#include "terrain/climate/lapse_rate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/random.h"
#include "terrain/climate/stations.h"
#include "tests/files.h"
#include "tests/paths.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

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
