#include "renderer/compose/view_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "base/math.h"
#include "renderer/paint/air.h"
#include "renderer/trace/camera.h"

namespace belvedere {
namespace {

// The renderer's own cameras are another implementation of the same pictures.
void expect_same_as_camera(const ViewShape& view, const char* projection) {
  const CameraParameters p{.projection = projection,
                           .width = 2400,
                           .height = static_cast<int>(std::lround(2400 / view.aspect)),
                           .eye = {1000.0, 2000.0, 5000.0},
                           .azimuth_deg = view.azimuth_deg,
                           .pitch_deg = view.pitch_deg,
                           .field_of_view_deg = view.field_of_view_deg};
  const std::unique_ptr<Camera> camera = make_camera(p);
  const ComposedPicture picture(view);
  for (const double off_deg : {-20.0, -7.0, 0.0, 3.0, 18.0})
    for (const double depression : {0.02, 0.2, 0.5}) {
      const glm::dvec2 direction(std::sin(to_radians(off_deg)), std::cos(to_radians(off_deg)));
      const glm::dvec2 on_map = to_map(direction, view.azimuth_deg);
      constexpr double far = 10000.0;
      const auto there = camera->project(p.eye + far * glm::dvec3(on_map, -depression));
      ASSERT_TRUE(there);
      const glm::dvec2 here = picture.position(direction, depression);
      EXPECT_NEAR(here.x, there->x / p.width, 1e-9)
          << projection << ' ' << off_deg << ' ' << depression;
      EXPECT_NEAR(here.y, there->y / p.height, 1e-9)
          << projection << ' ' << off_deg << ' ' << depression;
    }
}

TEST(ComposedPicture, IsThePerspectiveOfTheRenderer) {
  expect_same_as_camera(
      {.azimuth_deg = 217.0, .field_of_view_deg = 44.0, .aspect = 2.0, .pitch_deg = -18.0},
      "perspective");
}

TEST(ComposedPicture, IsTheCylinderOfTheRenderer) {
  expect_same_as_camera({.azimuth_deg = 31.0,
                         .field_of_view_deg = 110.0,
                         .aspect = 5.0,
                         .cylinder = true,
                         .pitch_deg = -12.0},
                        "cylindrical");
  expect_same_as_camera({.azimuth_deg = 31.0,
                         .field_of_view_deg = 360.0,
                         .aspect = 10.0,
                         .cylinder = true,
                         .pitch_deg = -12.0},
                        "cylindrical");
}

TEST(ViewShape, TheBendSinksByWhatItsSlopeSays) {
  ViewShape view;
  view.near_m = 20000.0, view.far_m = 50000.0, view.crest_m = 40000.0;
  view.radius_m = 65000.0;
  EXPECT_EQ(view.drop_m(5000.0), 35000.0 * 35000.0 / 130000.0);
  double sum = view.drop_m(5000.0);
  for (int k = 0; k < 70000; ++k) {
    sum -= view.slope(5000.5 + k);  // by the middles of metres
    if (k % 7000 == 0) {
      EXPECT_NEAR(view.drop_m(5001.0 + k), sum, 1e-3) << k;
    }
  }
}

TEST(ViewShape, FormatsGrowWiderWithTheirSheet) {
  double last = 0.0;
  for (const double aspect : {1.0, 1.414, 2.0, 3.0, 5.0}) {
    const FormatLimits limits = limits_of({.aspect = aspect});
    EXPECT_GT(limits.field_of_view_deg, last);
    EXPECT_LT(limits.min_field_deg, limits.field_of_view_deg);
    EXPECT_GT(limits.max_field_deg, limits.field_of_view_deg);
    EXPECT_EQ(limits.cylinder, aspect > 3.5);
    last = limits.field_of_view_deg;
  }
  EXPECT_NEAR(limits_of({.aspect = 2.0}).field_of_view_deg, 44.0, 1e-9);
  EXPECT_EQ(limits_of({.aspect = 10.0, .full_turn = true}).field_of_view_deg, 360.0);
}

TEST(ViewShape, DistancesGrowEvenly) {
  const std::vector<double> d = growing_distances(100.0, 1600.0, 5);
  ASSERT_EQ(d.size(), 5U);
  for (std::size_t i = 0; i < d.size(); ++i)
    EXPECT_NEAR(d[i], 100.0 * std::pow(2.0, static_cast<double>(i)), 1e-9);
}

TEST(ViewShape, FansReachBeyondTheEdges) {
  const std::vector<glm::dvec2> fan = fan_directions(60.0, false, 31);
  EXPECT_NEAR(fan[15].x, 0.0, 1e-12);
  EXPECT_NEAR(fan.back().x / fan.back().y, 1.12 * std::tan(to_radians(30.0)), 1e-9);
  const std::vector<glm::dvec2> ring = fan_directions(360.0, true, 36);
  // All directions, none twice.
  EXPECT_NEAR(std::atan2(ring.back().x, ring.back().y), to_radians(175.0), 1e-9);
  EXPECT_NEAR(std::atan2(ring.front().x, ring.front().y), to_radians(-175.0), 1e-9);
}

TEST(ViewDefaults, AreSharesOfTheHorizonsDistance) {
  const HorizonDefaults near = defaults_of_horizon(20000.0);
  EXPECT_NEAR(near.air_from_m, 9000.0, 1e-9);
  EXPECT_NEAR(near.air_scale_m, 12000.0, 1e-9);
  EXPECT_NEAR(near.rim_fade_m, 700.0, 1e-9);
  EXPECT_NEAR(near.foreground_to_m, 8400.0, 1e-9);
  EXPECT_NEAR(near.background_from_m, 19000.0, 1e-9);
  EXPECT_NEAR(defaults_of_horizon(80000.0).background_from_m, 4.0 * near.background_from_m, 1e-6);
}

// Warm and clear in front, cool behind: at .9 of the horizon's distance instead of .6 the last
// range had only a quarter of the haze, and regions with their own view were the same green from
// front to back.
TEST(ViewDefaults, TheLastRangeStandsInTheAirAndTheForegroundDoesNot) {
  for (const double far_m : {12000.0, 90000.0}) {
    const HorizonDefaults view = defaults_of_horizon(far_m);
    AirParameters air;
    air.haze = view_haze, air.from_m = view.air_from_m, air.scale_m = view.air_scale_m;
    const auto share = [&](double part, double above_m) {
      return haze_share(air, part * far_m, air.floor_m + above_m);
    };
    EXPECT_EQ(share(0.42, 0.0), 0.0);
    EXPECT_GT(foreground_warmth(air, 0.42 * far_m), 0.85F);
    EXPECT_LT(share(0.70, 0.0), 0.25) << "the middle stays clear";
    EXPECT_GT(share(1.0, 0.0), 0.42);
    EXPECT_LT(share(1.0, 0.0), 0.55) << "and readable";
    EXPECT_GT(share(1.0, 1500.0), 0.28) << "summits too";
  }
}

TEST(ViewDefaults, ThePaintersSunStandsToTheLeft) {
  EXPECT_EQ(painter_sun(180.0).azimuth_deg, 68.0) << "looking south, from the east";
  EXPECT_EQ(painter_sun(0.0).azimuth_deg, 248.0);
  EXPECT_EQ(painter_sun(-150.0).azimuth_deg, 98.0);
  EXPECT_EQ(painter_sun(10.0).altitude_deg, 31.0);
}

TEST(ViewDefaults, ValuesAreWrittenInFourFigures) {
  EXPECT_EQ(rounded_m(123456.0), 123500.0);
  EXPECT_EQ(rounded_m(9999.4), 9999.0);
  EXPECT_EQ(rounded_m(10001.0), 10000.0);
  EXPECT_EQ(rounded_m(0.4), 0.0);
  EXPECT_EQ(rounded_to(1.4349, 100.0), 1.43);
  EXPECT_EQ(turned_deg(-30.0), 330.0);
}

}  // namespace
}  // namespace belvedere
