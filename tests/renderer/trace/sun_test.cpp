#include "renderer/trace/sun.h"

#include <erfa.h>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "base/error.h"

namespace belvedere {
namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

struct Instant {
  int year, month, day, hour, minute;
  double second;
};

// The same from ERFA, the IAU's standards: geometric position of the sun, aberration by the Earth's
// speed, precession and nutation, sidereal time, parallax. It shares nothing with the algorithm
// under test.
SunPosition erfa(double longitude_deg, double latitude_deg, const Instant& t) {
  double day = 0.0;
  double part = 0.0;
  eraDtf2d("UTC", t.year, t.month, t.day, t.hour, t.minute, t.second, &day, &part);
  const double terrestrial =
      part + 69.0 / 86400.0;  // between UTC and TT; a minute moves the sun by 0.0007°
  double heliocentric[2][3];
  double barycentric[2][3];
  eraEpv00(day, terrestrial, heliocentric, barycentric);
  double sun[3];
  double distance = 0.0;
  const double light_days_per_au = 0.005775518331;
  for (int i = 0; i < 3; ++i) distance += heliocentric[0][i] * heliocentric[0][i];
  for (int i = 0; i < 3; ++i)
    sun[i] = -heliocentric[0][i] / std::sqrt(distance) + barycentric[1][i] * light_days_per_au;
  double to_date[3][3];
  eraPnm06a(day, terrestrial, to_date);
  double apparent[3];
  eraRxp(to_date, sun, apparent);
  double right_ascension = 0.0;
  double declination = 0.0;
  eraC2s(apparent, &right_ascension, &declination);
  const double hour_angle =
      eraGst06(day, part, day, terrestrial, to_date) + longitude_deg * degree - right_ascension;
  double azimuth = 0.0;
  double altitude = 0.0;
  eraHd2ae(hour_angle, declination, latitude_deg * degree, &azimuth, &altitude);
  return {azimuth / degree, altitude / degree - 8.794 / 3600.0 * std::cos(altitude)};
}

std::string iso(const Instant& t) {
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02.0f}Z", t.year, t.month, t.day, t.hour,
                     t.minute, t.second);
}

// Angle between two directions, degrees: near the zenith an azimuth alone is meaningless.
double apart_deg(const SunPosition& a, const SunPosition& b) {
  const glm::dvec3 u = sun_direction(a);
  const glm::dvec3 v = sun_direction(b);
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)) / degree;
}

TEST(Sun, AgreesWithTheStandardsOfAstronomy) {
  double worst = 0.0;
  double squares = 0.0;
  int count = 0;
  for (const auto& [longitude, latitude] : {std::pair{11.39, 47.27},
                                            {-121.76, 46.85},
                                            {-70.01, -32.65},
                                            {86.93, 27.99},
                                            {0.0, 0.0},
                                            {179.9, -45.0},
                                            {-16.0, 78.0}}) {
    for (const int year : {2020, 2024, 2031, 2040, 2050}) {
      for (int month = 1; month <= 12; ++month) {
        for (const int hour : {0, 5, 9, 12, 17, 22}) {
          const Instant t{year, month, 3 + 2 * month, hour, 37, 11.0};
          const double apart =
              apart_deg(sun_position(longitude, latitude, iso(t)), erfa(longitude, latitude, t));
          worst = std::max(worst, apart);
          squares += apart * apart;
          ++count;
          ASSERT_LE(apart, 0.01) << iso(t) << " at " << longitude << ' ' << latitude;
        }
      }
    }
  }
  EXPECT_LE(std::sqrt(squares / count), 0.0028);  // a missing parallax would show here
  RecordProperty("worst_deg", std::to_string(worst));
  RecordProperty("rms_deg", std::to_string(std::sqrt(squares / count)));
}

TEST(Sun, StaysUsableOutsideItsYears) {
  for (const int year : {1900, 1925, 1950, 1975, 2000, 2075, 2100}) {
    for (int month = 1; month <= 12; ++month) {
      const Instant t{year, month, 15, 10, 0, 0.0};
      EXPECT_LE(apart_deg(sun_position(11.39, 47.27, iso(t)), erfa(11.39, 47.27, t)), 0.02)
          << iso(t);
    }
  }
}

TEST(Sun, StandsInTheSouthAtNoonAndInTheNorthBelowTheEquator) {
  // Innsbruck, solstice: 90 - 47.27 + 23.44.
  const SunPosition noon = sun_position(11.39, 47.27, "2024-06-20T11:16:00Z");
  EXPECT_NEAR(noon.azimuth_deg, 180.0, 0.5);
  EXPECT_NEAR(noon.altitude_deg, 66.17, 0.02);
  const SunPosition andes = sun_position(-70.01, -32.65, "2024-06-20T16:42:00Z");
  EXPECT_NEAR(std::remainder(andes.azimuth_deg, 360.0), 0.0, 0.5);
  EXPECT_NEAR(andes.altitude_deg, 90.0 - 32.65 - 23.44, 0.02);
  EXPECT_LT(sun_position(11.39, 47.27, "2024-06-20T23:16:00Z").altitude_deg, 0.0);
}

TEST(Sun, ZonesAndFractionsMeanTheSameInstant) {
  const auto at = [](const char* time) { return sun_position(11.39, 47.27, time); };
  const SunPosition utc = at("2024-07-15T09:30:00Z");
  for (const char* same :
       {"2024-07-15T11:30:00+02:00", "2024-07-15T09:30Z", "2024-07-15T09:30:00.000Z",
        "2024-07-15T00:00:00-09:30", "2024-07-14T23:30:00-10:00", "2024-07-15T09:30:00+00:00"}) {
    EXPECT_LT(apart_deg(utc, at(same)), 1e-9) << same;
  }
  // Across midnight, a month and a leap day.
  EXPECT_LT(apart_deg(at("2024-03-01T00:30:00+01:00"), at("2024-02-29T23:30:00Z")), 1e-9);
  EXPECT_LT(apart_deg(at("2025-01-01T01:00:00+02:00"), at("2024-12-31T23:00:00Z")), 1e-9);
  // Half a second is 0.002° of the sky.
  EXPECT_NEAR(apart_deg(at("2024-07-15T09:30:00.5Z"), utc), 0.0019, 0.0003);
}

TEST(Sun, AnythingElseIsAnError) {
  for (const char* wrong : {"",
                            "2024-07-15",
                            "2024-07-15T09:30:00",
                            "2024-07-15 09:30:00Z",
                            "2024-7-15T09:30:00Z",
                            "2024-13-15T09:30:00Z",
                            "2024-00-15T09:30:00Z",
                            "2023-02-29T09:30:00Z",
                            "2100-02-29T09:30:00Z",
                            "2024-04-31T09:30:00Z",
                            "2024-07-00T09:30:00Z",
                            "2024-07-15T24:00:00Z",
                            "2024-07-15T09:60:00Z",
                            "2024-07-15T09:30:60Z",
                            "2024-07-15T09:30:00+0200",
                            "2024-07-15T09:30:00+15:00",
                            "2024-07-15T09:30:00+02:60",
                            "2024-07-15T09:30:00z",
                            "2024-07-15T09:30:00ZZ",
                            " 2024-07-15T09:30:00Z",
                            "2024-07-15T09:30:00.Z",
                            "2024-07-15T09Z",
                            "1899-07-15T09:30:00Z",
                            "2101-01-01T00:00:00Z",
                            "+024-07-15T09:30:00Z",
                            "2024-07-15T09:30:00 Z"}) {
    try {
      sun_position(11.0, 47.0, wrong);
      ADD_FAILURE() << "taken: " << wrong;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_FALSE(error.allowed().empty());
    }
  }
  EXPECT_NO_THROW(sun_position(11.0, 47.0, "2024-02-29T09:30:00Z"));
  EXPECT_NO_THROW(sun_position(11.0, 47.0, "2000-02-29T09:30:00Z"));
  EXPECT_THROW(sun_position(181.0, 47.0, "2024-07-15T09:30:00Z"), Error);
  EXPECT_THROW(sun_position(11.0, -90.5, "2024-07-15T09:30:00Z"), Error);
  EXPECT_THROW(sun_position(std::nan(""), 47.0, "2024-07-15T09:30:00Z"), Error);
}

TEST(SunDirection, IsAUnitVectorEastNorthUp) {
  const auto near = [](glm::dvec3 a, glm::dvec3 b) { return glm::length(a - b) < 1e-12; };
  EXPECT_TRUE(near(sun_direction({0.0, 0.0}), {0, 1, 0}));
  EXPECT_TRUE(near(sun_direction({90.0, 0.0}), {1, 0, 0}));
  EXPECT_TRUE(near(sun_direction({180.0, 0.0}), {0, -1, 0}));
  EXPECT_TRUE(near(sun_direction({123.0, 90.0}), {0, 0, 1}));
  EXPECT_TRUE(near(sun_direction({315.0, 30.0}), {-std::sqrt(0.375), std::sqrt(0.375), 0.5}));
}

}  // namespace
}  // namespace belvedere
