#include "terrain/climate/sun_year.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/angle.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

double level_mj(double latitude_deg, const SunYearParameters& parameters) {
  double sum = 0.0;
  for (const SunMoment& sun : sun_moments(latitude_deg, parameters))
    sum += sun.exposure_mj * sun.sine;
  return sum;
}

TEST(SunYear, ADayAboveTheAirIsTheTextbooks) {
  // Duffie & Beckman's formula H0 = 24/π G E0 (cos φ cos δ sin ωs + ωs sin φ sin δ); 42° N, 21
  // June: 11.6 kWh.
  for (const int day : {15, 80, 172, 300})
    for (const double latitude : {-50.0, 0.0, 42.0, 60.0}) {
      const SunOfDay sun = sun_of_day(day);
      const double phi = to_radians(latitude);
      const double set = std::acos(-std::tan(phi) * std::tan(sun.declination_rad));
      const double expected = 24.0 / std::numbers::pi * 3600e-6 * 1367.0 * sun.nearness *
                              (std::cos(phi) * std::cos(sun.declination_rad) * std::sin(set) +
                               set * std::sin(phi) * std::sin(sun.declination_rad));
      EXPECT_NEAR(level_mj(latitude, {.first_day = day, .last_day = day}), expected,
                  2e-4 * expected)
          << day << ' ' << latitude;
    }
  EXPECT_NEAR(level_mj(42.0, {.first_day = 172, .last_day = 172}) / 3.6, 11.647, 0.03);
}

TEST(SunYear, SpansOfDaysAddUpAndRunOverTheNewYear) {
  const double year = level_mj(47.0, {});
  const double summer = level_mj(47.0, {.first_day = 100, .last_day = 280});
  const double winter = level_mj(47.0, {.first_day = 281, .last_day = 99});
  EXPECT_NEAR(summer + winter, year, 1e-9 * year);
  EXPECT_GT(summer, 2.0 * winter);
}

TEST(SunYear, MorningsAreInTheEastNoonsInTheSouthAndTheAirIsThickAtTheHorizon) {
  for (const SunMoment& sun :
       sun_moments(47.0, {.first_day = 80, .last_day = 80, .step_min = 10.0})) {
    if (sun.sine < 0.05) {
      EXPECT_GT(sun.air_mass, 12.0);
    } else if (sun.sine > 0.68) {
      EXPECT_NEAR(to_degrees(sun.azimuth_rad), 180.0, 5.0);
    }
    EXPECT_NEAR(sun.sine * sun.sine + sun.cosine * sun.cosine, 1.0, 1e-12);
  }
  EXPECT_LT(to_degrees(sun_moments(47.0, {.first_day = 80, .last_day = 80}).front().azimuth_rad),
            95.0);
  EXPECT_TRUE(sun_moments(80.0, {.first_day = 355, .last_day = 355}).empty()) << "polar night";
}

TEST(SunYear, ClearAirLetsMoreThroughHigherUp) {
  EXPECT_NEAR(clear_share(0.75, 1.0, 0.0), 0.75, 1e-12);
  EXPECT_NEAR(clear_share(0.75, 2.0, 0.0), 0.5625, 1e-12);
  EXPECT_NEAR(clear_share(0.75, 1.0, 8434.5), std::pow(0.75, std::exp(-1.0)), 1e-12);
}

TEST(SunYear, TheTableHoldsWhatTheSunSendsFromAboveATangent) {
  const SunYearParameters parameters{.step_min = 10.0};
  constexpr int sectors = 16;
  const SunTable table(46.0, 46.0, 0.0, 2000.0, 0.0, sectors, parameters);
  ASSERT_EQ(table.latitudes(), 1);
  for (const float tangent : {0.0F, 0.2F, 0.7F}) {
    double sum = 0.0;
    for (int s = 0; s < sectors; ++s)
      sum +=
          static_cast<double>(table.sums(s)[SunTable::step_of(tangent) * SunTable::altitudes * 4]);
    double expected = 0.0;
    for (const SunMoment& sun : sun_moments(46.0, parameters))
      if (sun.sine > static_cast<double>(tangent) * sun.cosine)
        expected +=
            sun.exposure_mj * sun.sine * clear_share(parameters.transmissivity, sun.air_mass, 0.0);
    EXPECT_NEAR(sum, expected, 1e-3 * expected) << tangent;
  }
  EXPECT_FALSE(table.lit(0)) << "no sun in the north";
  EXPECT_TRUE(table.lit(sectors / 2));
}

TEST(SunYear, WhatIsOutOfRangeIsNamed) {
  EXPECT_THAT(test::message_of(ErrorKind::usage, [] { sun_moments(47.0, {.first_day = 0}); }),
              HasSubstr("first_day"));
  EXPECT_THAT(
      test::message_of(ErrorKind::usage, [] { sun_moments(47.0, {.transmissivity = 1.5}); }),
      HasSubstr("transmissivity"));
  EXPECT_THAT(test::message_of(ErrorKind::usage, [] { sun_moments(91.0, {}); }),
              HasSubstr("latitude"));
}

}  // namespace
}  // namespace belvedere
