#include "renderer/trace/light_field.h"

#include <erfa.h>
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/math_exact.h"
#include "base/random.h"
#include "tests/files.h"

namespace belvedere {
namespace {

const glm::dvec3 north_west = glm::normalize(glm::dvec3(-0.6, 0.6, 0.5));
const glm::dvec3 south_east = glm::normalize(glm::dvec3(0.5, -0.7, 0.4));
const glm::dvec2 right{-1.0, 0.0};  // of a view to the south

LightField with_regions(std::vector<LightRegion> regions) {
  return {north_west, right, std::move(regions), {}, 1};
}
LightField with_cloud(const CloudShadow& cloud, std::uint64_t seed = 1) {
  return {north_west, right, {}, {cloud}, seed};
}

TEST(LightField, ARegionHoldsInsideAndFadesOverItsBlend) {
  const LightRegion region{.centre = {1000.0, 2000.0}, .radius_m = 500.0, .blend_m = 400.0};
  const auto weight = [&](double from_centre) {
    return LightField::weight(region, {1000.0 + from_centre, 2000.0});
  };
  EXPECT_EQ(weight(0.0), 1.0);
  EXPECT_EQ(weight(500.0), 1.0);
  EXPECT_NEAR(weight(600.0), 1.0 - 5.0 / 32.0, 1e-12);  // 3t² - 2t³ at a quarter
  EXPECT_NEAR(weight(700.0), 0.5, 1e-12);
  EXPECT_EQ(weight(900.0), 0.0);
  LightRegion hard = region;
  hard.blend_m = 0.0;
  EXPECT_EQ(LightField::weight(hard, {1500.0, 2000.0}), 1.0);
  EXPECT_EQ(LightField::weight(hard, {1500.1, 2000.0}), 0.0);
}

TEST(LightField, AnOutlineHasHolesAndCorners) {
  const LightRegion region{.rings = {{{0, 0}, {1000, 0}, {1000, 1000}, {0, 1000}},
                                     {{400, 400}, {600, 400}, {600, 600}, {400, 600}}},
                           .blend_m = 200.0};
  EXPECT_EQ(LightField::weight(region, {200.0, 500.0}), 1.0);
  EXPECT_NEAR(LightField::weight(region, {500.0, 500.0}), 0.5,
              1e-12);  // in the centre of the hole, 100 m from its edge
  EXPECT_NEAR(LightField::weight(region, {1100.0, 500.0}), 0.5, 1e-12);
  EXPECT_NEAR(LightField::weight(region, {1060.0, 1080.0}), 0.5, 1e-12);  // 100 m from the corner
  EXPECT_EQ(LightField::weight(region, {1150.0, 1150.0}), 0.0);
}

// The weighted sum of unit vectors, normalized; the other values linear.
TEST(LightField, BlendsByWeight) {
  const LightRegion region{.centre = {0.0, 0.0},
                           .radius_m = 500.0,
                           .blend_m = 400.0,
                           .sun_direction = south_east,
                           .strength = 1.4,
                           .warmth = 0.8};
  const LightField field = with_regions({region});
  for (const double x : {0.0, 520.0, 640.0, 700.0, 830.0}) {
    const double share = LightField::weight(region, {x, 0.0});
    const GroundLight light = field.at({x, 0.0});
    EXPECT_LT(
        glm::length(light.sun - glm::normalize(north_west * (1.0 - share) + south_east * share)),
        1e-12)
        << x;
    EXPECT_NEAR(light.strength, 1.0 + 0.4 * share, 1e-6) << x;
    EXPECT_NEAR(light.warmth, 0.8 * share, 1e-6) << x;
    EXPECT_NEAR(light.side, 1.0 - 2.0 * share, 1e-6)
        << x;  // a view to the south has the north-west on its right
  }
  const GroundLight outside = field.at({901.0, 0.0});
  EXPECT_EQ(outside.sun, north_west) << "bit for bit";
  EXPECT_EQ(outside.strength, 1.0F);
  EXPECT_EQ(outside.warmth, 0.0F);
  EXPECT_EQ(outside.side, 1.0F);
}

TEST(LightField, LaterRegionsLieOverEarlierOnes) {
  const LightRegion below{.radius_m = 1000.0, .sun_direction = south_east, .strength = 0.5};
  const LightRegion above{
      .radius_m = 300.0, .blend_m = 0.0, .sun_direction = {0.0, 0.0, 1.0}, .strength = 1.5};
  EXPECT_EQ(with_regions({below, above}).at({0.0, 0.0}).strength, 1.5F);
  EXPECT_EQ(with_regions({above, below}).at({0.0, 0.0}).strength, 0.5F);
}

// With everything rotated about the vertical axis, the light is the same, rotated: no direction of
// the map is special.
TEST(LightField, TurnsWithTheMap) {
  const exact::Turn by = exact::turn(0.7);
  const auto turn2 = [&](glm::dvec2 v) {
    return glm::dvec2(v.x * by.cosine - v.y * by.sine, v.x * by.sine + v.y * by.cosine);
  };
  const auto turn3 = [&](glm::dvec3 v) { return glm::dvec3(turn2(glm::dvec2(v)), v.z); };
  LightRegion circle{.centre = {800.0, 300.0},
                     .radius_m = 400.0,
                     .blend_m = 600.0,
                     .sun_direction = south_east,
                     .strength = 1.3,
                     .warmth = -0.4};
  LightRegion outline{.rings = {{{-500, -200}, {300, -350}, {100, 500}}},
                      .blend_m = 350.0,
                      .sun_direction = {0.0, 0.0, 1.0},
                      .strength = 0.8};
  const LightField field(north_west, right, {circle, outline}, {}, 1);
  circle.centre = turn2(circle.centre);
  circle.sun_direction = turn3(circle.sun_direction);
  for (glm::dvec2& corner : outline.rings.front()) corner = turn2(corner);
  const LightField turned(turn3(north_west), turn2(right), {circle, outline}, {}, 1);
  for (int k = 0; k < 400; ++k) {
    const glm::dvec2 position{3000.0 * random_uniform(7, k, 0) - 1500.0,
                              3000.0 * random_uniform(7, k, 1) - 1500.0};
    const GroundLight here = field.at(position);
    const GroundLight there = turned.at(turn2(position));
    EXPECT_LT(glm::length(turn3(here.sun) - there.sun), 1e-9);
    EXPECT_NEAR(here.strength, there.strength, 1e-5);
    EXPECT_NEAR(here.warmth, there.warmth, 1e-5);
    EXPECT_NEAR(here.side, there.side, 1e-5);
    EXPECT_NEAR(glm::length(here.sun), 1.0, 1e-12);
  }
}

TEST(LightField, ACloudTakesItsShareInTheMiddleAndNothingBeyond) {
  const CloudShadow cloud{
      .centre = {5000.0, 5000.0}, .radius_m = 2000.0, .strength = 0.8, .blend_m = 1000.0};
  const LightField field = with_cloud(cloud);
  const float centre = field.at(cloud.centre).strength;
  EXPECT_GE(centre, 0.2F);
  EXPECT_LE(centre, 0.2F + 0.8F * 0.12F + 1e-6F);
  // Noise moves the edge by at most .72 of the radius.
  for (int k = 0; k < 64; ++k) {
    const exact::Turn way = exact::turn(0.1 * k);
    const glm::dvec2 out =
        cloud.centre + (2000.0 * 1.72 + 501.0) * glm::dvec2(way.cosine, way.sine);
    EXPECT_EQ(field.at(out).strength, 1.0F);
    EXPECT_LT(field.at(cloud.centre + (2000.0 * 0.28 - 501.0) * glm::dvec2(way.cosine, way.sine))
                  .strength,
              0.3F);
  }
  EXPECT_FALSE(field.turns_sun());
  EXPECT_EQ(field.at(cloud.centre).sun, north_west);
}

// Soft: over the whole edge the strength changes by no more than blend and lobes allow; lobed: the
// edge varies in distance.
TEST(LightField, ACloudIsSoftAndLobed) {
  const CloudShadow cloud{
      .centre = {0.0, 0.0}, .radius_m = 2000.0, .strength = 1.0, .blend_m = 1200.0};
  const LightField field = with_cloud(cloud);
  double nearest = 1e9;
  double farthest = 0.0;
  for (int k = 0; k < 90; ++k) {
    const exact::Turn way = exact::turn(0.0698 * k);
    float before = field.at({0.0, 0.0}).strength;
    double edge = 0.0;
    for (double r = 25.0; r < 5000.0; r += 25.0) {
      const float here = field.at(r * glm::dvec2(way.cosine, way.sine)).strength;
      EXPECT_LT(std::abs(here - before), 0.12F);
      if (before < 0.5F && here >= 0.5F) edge = r;
      before = here;
    }
    nearest = std::min(nearest, edge);
    farthest = std::max(farthest, edge);
  }
  EXPECT_GT(farthest - nearest, 600.0);
  // Another seed or another position gives another cloud.
  EXPECT_NE(field.at({1800.0, 300.0}).strength, with_cloud(cloud, 2).at({1800.0, 300.0}).strength);
}

TEST(LightField, RefusesSunsBelowTheHorizon) {
  EXPECT_THROW(with_regions({{.radius_m = 1.0, .sun_direction = {1.0, 0.0, 0.0}}}), Error);
  EXPECT_THROW(LightField({1.0, 0.0, -0.1}, right, {}, {}, 1), Error);
}

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
    for (const int year : {2020, 2024, 2031, 2040, 2050})
      for (int month = 1; month <= 12; ++month)
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
  EXPECT_LE(std::sqrt(squares / count), 0.0028);  // a missing parallax would show here
  RecordProperty("worst_deg", std::to_string(worst));
  RecordProperty("rms_deg", std::to_string(std::sqrt(squares / count)));
}

TEST(Sun, StaysUsableOutsideItsYears) {
  for (const int year : {1900, 1925, 1950, 1975, 2000, 2075, 2100})
    for (int month = 1; month <= 12; ++month) {
      const Instant t{year, month, 15, 10, 0, 0.0};
      EXPECT_LE(apart_deg(sun_position(11.39, 47.27, iso(t)), erfa(11.39, 47.27, t)), 0.02)
          << iso(t);
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
    const Error error = test::error_of([&] { sun_position(11.0, 47.0, wrong); });
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_FALSE(error.allowed().empty());
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
