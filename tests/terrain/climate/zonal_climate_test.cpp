#include "terrain/climate/zonal_climate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/math.h"
#include "terrain/climate/default_climate.h"
#include "terrain/climate/water_balance.h"
#include "tests/terrain/climate/published_lines.h"
#include "tests/terrain/climate/synthetic_months.h"

namespace belvedere {
namespace {

using test::published_lines;
using test::PublishedLine;
using testing::HasSubstr;

struct LineMisses {
  double rms_m = 0.0;
  double mean_m = 0.0;
};

template <class F>
LineMisses misses_of(const std::vector<PublishedLine>& lines, F&& line_of) {
  LineMisses misses;
  for (const PublishedLine& line : lines) {
    const double found = line_of(line);
    const double miss = found - line.altitude_m;
    misses.rms_m += miss * miss;
    misses.mean_m += miss;
  }
  const auto n = static_cast<double>(lines.size());
  misses = {std::sqrt(misses.rms_m / n), misses.mean_m / n};
  return misses;
}

double km_between(double lat_a, double lon_a, double lat_b, double lon_b) {
  const double c = std::sin(to_radians(lat_a)) * std::sin(to_radians(lat_b)) +
                   std::cos(to_radians(lat_a)) * std::cos(to_radians(lat_b)) *
                       std::cos(to_radians(lon_a - lon_b));
  return 6371.0 * std::acos(std::clamp(c, -1.0, 1.0));
}

// Stations farther than that from a place.
std::vector<ClimateStation> stations_away(const PublishedLine& line, double min_km) {
  std::vector<ClimateStation> away;
  for (const ClimateStation& s : read_climate_stations())
    if (km_between(s.latitude_deg, s.longitude_deg, line.latitude_deg, line.longitude_deg) > min_km)
      away.push_back(s);
  return away;
}

TEST(ZonalClimate, TreelinesAreThePublishedOnes) {
  const std::vector<PublishedLine> lines = published_lines("treelines");
  ASSERT_GE(lines.size(), 27U);
  const LineMisses misses = misses_of(lines, [](const PublishedLine& l) {
    return treeline_m(default_climate(l.longitude_deg, l.latitude_deg));
  });
  EXPECT_LT(misses.rms_m, 300.0);
  EXPECT_LT(std::abs(misses.mean_m), 50.0);
}

// No line depends on a single nearby station.
TEST(ZonalClimate, LinesHoldWithoutTheStationsNearThem) {
  const auto every_third = [](std::vector<PublishedLine> lines) {
    std::vector<PublishedLine> some;
    for (std::size_t k = 0; k < lines.size(); k += 3) some.push_back(lines[k]);
    return some;
  };
  const auto climate_without = [](const PublishedLine& l) {
    return place_climate(make_climate_field(stations_away(l, 100.0)), l.longitude_deg,
                         l.latitude_deg);
  };
  EXPECT_LT(misses_of(every_third(published_lines("treelines")),
                      [&](const PublishedLine& l) { return treeline_m(climate_without(l)); })
                .rms_m,
            330.0);
}

// A lone cone of 3800 m at 35° N has no perennial snow on its open slopes; neither has a desert
// range.
TEST(ZonalClimate, NoSnowStaysOnASubtropicalVolcano) {
  SnowParameters open;
  open.gathering = 1.0;
  EXPECT_GT(snow_line_m(default_climate(138.73, 35.36), open), 3776.0);
  EXPECT_GT(snow_line_m(default_climate(-111.68, 35.33)), 3851.0);
}

TEST(ZonalClimate, StationsAreToldByTheOthers) {
  const std::vector<ClimateStation> stations = read_climate_stations();
  ASSERT_GT(stations.size(), 400U);
  // Every tenth is left out and predicted from the others, at its own altitude.
  double july = 0.0;
  double rain = 0.0;
  int count = 0;
  for (std::size_t fold = 0; fold < 3; ++fold) {
    std::vector<ClimateStation> kept;
    for (std::size_t k = 0; k < stations.size(); ++k)
      if (k % 10 != fold) kept.push_back(stations[k]);
    const ClimateField field = make_climate_field(kept);
    for (std::size_t k = fold; k < stations.size(); k += 10) {
      const ClimateStation& s = stations[k];
      if (s.rain_mm < 100.0 || std::abs(s.latitude_deg) > 75.0) continue;
      const PlaceClimate position = place_climate(field, s.longitude_deg, s.latitude_deg);
      july += std::pow(monthly_c(position, s.altitude_m)[6] - s.season_c[2], 2.0);
      rain += std::pow(std::log(rain_mm(position, s.altitude_m) / s.rain_mm), 2.0);
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(july / count), 2.5);
  EXPECT_LT(std::exp(std::sqrt(rain / count)), 2.1);
}

TEST(ZonalClimate, IsSmoothOverTheGlobe) {
  // Across the date line, round the poles, and in steps of a tenth of a degree anywhere.
  const auto near = [](const PlaceClimate& a, const PlaceClimate& b, double kelvin) {
    for (std::size_t m = 0; m < 12; ++m) EXPECT_NEAR(a.sea_level_c[m], b.sea_level_c[m], kelvin);
    for (std::size_t k = 0; k < 8; ++k)
      EXPECT_NEAR(a.rain_mm_at_km[k], b.rain_mm_at_km[k],
                  1e-3 + kelvin * (2.0 + 0.2 * a.rain_mm_at_km[k]));  // behind ranges it falls fast
  };
  near(default_climate(180.0, 66.0), default_climate(-180.0, 66.0), 1e-6);
  near(default_climate(10.0, 90.0), default_climate(-150.0, 90.0), 1e-6);
  near(default_climate(10.0, -90.0), default_climate(-150.0, -90.0), 1e-6);
  for (double latitude = -85.0; latitude < 86.0; latitude += 19.0)
    for (double longitude = -177.0; longitude < 180.0; longitude += 43.0)
      near(default_climate(longitude, latitude), default_climate(longitude + 0.1, latitude + 0.1),
           1.5);
}

TEST(ZonalClimate, IsSoundEverywhere) {
  for (double latitude = -90.0; latitude <= 90.0; latitude += 15.0)
    for (double longitude = -180.0; longitude < 180.0; longitude += 30.0) {
      const PlaceClimate position = default_climate(longitude, latitude);
      for (std::size_t m = 0; m < 12; ++m) {
        EXPECT_GT(position.sea_level_c[m], -75.0) << latitude << " " << longitude;
        EXPECT_LT(position.sea_level_c[m], 55.0) << latitude << " " << longitude;
      }
      for (const double rain : position.rain_mm_at_km) {
        EXPECT_GE(rain, 0.0);
        EXPECT_LT(rain, 8000.0);
      }
      EXPECT_LE(snow_line_m(position, {1.0, 0.0}), 9000.0);
    }
}

TEST(ZonalClimate, MonthsAndRainFollowTheLines) {
  PlaceClimate position;
  position.sea_level_c.fill(20.0);
  position.lapse_k_per_km.fill(6.0);
  position.rain_mm_at_km = {1000.0, 1200.0, 1600.0, 1600.0, 1600.0, 1600.0, 1600.0, 800.0};
  position.summer_share = 0.7;
  EXPECT_DOUBLE_EQ(monthly_c(position, 2500.0)[4], 5.0);
  EXPECT_NEAR(rain_mm(position, 1250.0), 1300.0, 1e-9);
  EXPECT_NEAR(rain_mm(position, -400.0), 1000.0, 1e-9);
  EXPECT_NEAR(rain_mm(position, 8800.0), 800.0, 1e-9);
  const Months rain = monthly_rain_mm(position, 1000.0);
  double year = 0.0;
  double summer = 0.0;
  for (std::size_t m = 0; m < 12; ++m) {
    year += rain[m];
    if (m >= 3 && m < 9) summer += rain[m];
  }
  EXPECT_NEAR(year, 1200.0, 1e-9);
  EXPECT_NEAR(summer, 0.7 * 1200.0, 1e-9);
}

TEST(ZonalClimate, BadStationsNameTheirLine) {
  const auto message_of = [](const std::string& text) {
    try {
      climate_stations_from_toml(text, "s.toml");
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(message_of("version = 1\nstations = [\n[\"A\", 95.0, 0, 0, 1, 2, 3, 2, 500, 0.5]]"),
              HasSubstr("s.toml:3"));
  EXPECT_THAT(message_of("version = 1\nstations = [\n[\"A\", 45.0, 0]]"), HasSubstr("s.toml:3"));
  EXPECT_THAT(message_of("version = 2\nstations = []"), HasSubstr("version = 1"));
  EXPECT_THROW(make_climate_field({}), Error);
}

using test::constant;
using test::seasons;

TEST(Treeline, IsWhereTheExcessIsNone) {
  PlaceClimate position;
  position.sea_level_c = seasons(11.0, 10.0);
  position.lapse_k_per_km.fill(5.5);
  const double line = treeline_m(position);
  EXPECT_NEAR(treeline_excess_k(monthly_c(position, line)), 0.0, 1e-4);
  // A kelvin is worth 1000 / 5.5 m.
  EXPECT_NEAR(treeline_m(position, 1.0) - line, 1000.0 / 5.5, 0.05);
  // Without seasons: 6.4 °C.
  position.sea_level_c = constant(28.4);
  EXPECT_NEAR(treeline_m(position), 4000.0, 0.05);
}

constexpr double pi = std::numbers::pi;

// Monthly means, in closed form, of mean + swing · cos(2π · waves · (t - phase)), t in years.
Months means_of_wave(double mean, double swing, int waves, double phase) {
  Months months{};
  for (std::size_t m = 0; m < 12; ++m) {
    const double w = 2.0 * pi * waves;
    const double from = static_cast<double>(m) / 12.0 - phase;
    months[m] = mean + swing * 12.0 / w * (std::sin(w * (from + 1.0 / 12.0)) - std::sin(w * from));
  }
  return months;
}

TEST(DailyCourse, IsTheWaveWhoseMeansWereGiven) {
  for (const int waves : {1, 2, 5}) {
    const auto days = daily_c(means_of_wave(3.0, 9.0, waves, 0.07));
    for (std::size_t d = 0; d < 365; d += 7) {
      const double t = (static_cast<double>(d) + 0.5) / 365.0 - 0.07;
      EXPECT_NEAR(days[d], 3.0 + 9.0 * std::cos(2.0 * pi * waves * t), 1e-9) << waves << " " << d;
    }
  }
}

TEST(GrowingSeason, OfAWaveIsItsClosedForm) {
  // Of 10 · cos above .9: cos θ = .09 on each side; the mean is 10 · sin θ / θ.
  const GrowingSeason season = growing_season(means_of_wave(0.0, 10.0, 1, 0.55));
  const double half = std::acos(0.09);
  EXPECT_NEAR(season.days, 365.0 * half / pi, 0.02);
  EXPECT_NEAR(season.mean_c, 10.0 * std::sin(half) / half, 2e-3);
}

TEST(GrowingSeason, WithoutSeasons) {
  EXPECT_NEAR(growing_season(constant(7.0)).days, 365.0, 1e-9);
  EXPECT_NEAR(growing_season(constant(7.0)).mean_c, 7.0, 1e-9);
  EXPECT_EQ(growing_season(constant(0.5)).days, 0.0);
  EXPECT_EQ(growing_season(constant(0.5)).mean_c, 0.0);
}

TEST(Treeline, ExcessCountsKelvin) {
  EXPECT_NEAR(treeline_excess_k(constant(6.4)), 0.0, 1e-5);
  EXPECT_NEAR(treeline_excess_k(constant(1.4)), 5.0, 1e-5);
  EXPECT_NEAR(treeline_excess_k(constant(26.4)), -20.0, 1e-5);
  const Months wave = means_of_wave(-2.0, 14.0, 1, 0.55);
  Months colder = wave;
  for (double& t : colder) t -= 3.25;
  EXPECT_NEAR(treeline_excess_k(colder) - treeline_excess_k(wave), 3.25, 1e-5);
}

TEST(Treeline, ShortSummersNeedTheirDays) {
  // Summers 14 K above a cold year: warm enough, but shorter than 94 days, so that days decide and
  // not the mean.
  const Months wave = means_of_wave(-31.0, 45.0, 1, 0.55);
  const double excess = treeline_excess_k(wave);
  Months at_line = wave;
  for (double& t : at_line) t += excess;
  const GrowingSeason season = growing_season(at_line);
  EXPECT_NEAR(season.days, 94.0, 0.01);
  EXPECT_GT(season.mean_c, 6.4);
}

TEST(HighestAltitude, IsFoundToAMillimetre) {
  EXPECT_NEAR(highest_m([](double m) { return m < 1234.567; }), 1234.567, 2e-3);
  EXPECT_NEAR(highest_m([](double m) { return m < -50.0 || (m > 3000.0 && m < 3333.3); }), 3333.3,
              2e-3);
  EXPECT_EQ(highest_m([](double) { return true; }), 9000.0);
  EXPECT_EQ(highest_m([](double) { return false; }), -2000.0);
}

}  // namespace

}  // namespace belvedere
