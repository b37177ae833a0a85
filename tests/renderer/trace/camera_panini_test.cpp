#include "renderer/trace/camera_panini.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/angle.h"

namespace belvedere {
namespace {

CameraParameters wide(double field_of_view_deg, double pitch_deg = 0.0) {
  CameraParameters p;
  p.projection = "panini";
  p.width = 800;
  p.height = 400;
  p.eye = {692000.0, 5302000.0, 2200.0};
  p.azimuth_deg = 182.0;
  p.pitch_deg = pitch_deg;
  p.field_of_view_deg = field_of_view_deg;
  return p;
}

// A position 7 km away, turned from the centre of the picture, at this height above the eye.
glm::dvec3 position(const CameraParameters& p, double turn_deg, double above_m) {
  const double bearing = to_radians(p.azimuth_deg + turn_deg);
  return p.eye + glm::dvec3(7000.0 * std::sin(bearing), 7000.0 * std::cos(bearing), above_m);
}

TEST(CameraPanini, IsThePerspectiveWhereTheDistanceIsZero) {
  CameraParameters p = wide(110.0);
  const auto panini = make_panini_camera(p, 0.0);
  p.projection = "perspective";
  const auto perspective = make_camera(p);
  for (double y = 3.0; y < 400.0; y += 56.5)
    for (double x = 1.0; x < 800.0; x += 66.5) {
      EXPECT_LT(glm::length(panini->ray({x, y}).direction - perspective->ray({x, y}).direction),
                1e-12)
          << x << ' ' << y;
      const glm::dvec3 point = p.eye + 9000.0 * perspective->ray({x, y}).direction;
      EXPECT_NEAR(panini->project(point)->x, x, 1e-6);
      EXPECT_NEAR(panini->project(point)->y, y, 1e-6);
    }
  EXPECT_FALSE(panini->project(position(p, 120.0, 0.0)));
}

TEST(CameraPanini, KnownAnglesLieWhereTheFormulaSays) {
  // With d = 1, x = 2 tan(φ / 2) and y = 2 tan θ / (1 + cos φ): at 180 degrees the edge is x = 2,
  // so a unit is 200 px.
  const CameraParameters p = wide(180.0);
  const auto camera = make_camera(p);
  for (const double turn : {-90.0, -60.0, -20.0, 0.0, 45.0, 90.0, 150.0}) {
    const auto at = camera->project(position(p, turn, 1400.0));
    ASSERT_TRUE(at);
    const double phi = to_radians(turn);
    EXPECT_NEAR(at->x, 400.0 + 400.0 * std::tan(0.5 * phi), 1e-6) << turn;
    EXPECT_NEAR(at->y, 200.0 - 400.0 * 0.2 / (1.0 + std::cos(phi)), 1e-6) << turn;
  }
  EXPECT_NEAR(camera->project(position(p, 60.0, 0.0))->x, 400.0 + 400.0 / std::sqrt(3.0), 1e-6);
  EXPECT_FALSE(camera->project(p.eye + glm::dvec3(0.0, 0.0, 100.0)));
}

TEST(CameraPanini, ProjectUndoesRayAtEveryWidth) {
  for (const double width : {20.0, 100.0, 140.0, 180.0, 240.0})
    for (const double distance : {0.4, 1.0}) {
      if (distance < 1.0 && width > 180.0) continue;  // the cylinder's picture ends before that
      const CameraParameters p = wide(width, -12.0);
      const auto camera = make_panini_camera(p, distance);
      for (double y = -20.0; y <= 430.0; y += 37.3)
        for (double x = -30.0; x <= 830.0; x += 41.7) {
          const Ray ray = camera->ray({x, y});
          EXPECT_NEAR(glm::length(ray.direction), 1.0, 1e-14);
          const auto back = camera->project(ray.origin + 9000.0 * ray.direction);
          ASSERT_TRUE(back) << width;
          EXPECT_NEAR(back->x, x, 1e-6) << width << ' ' << distance;
          EXPECT_NEAR(back->y, y, 1e-6) << width << ' ' << distance;
        }
    }
}

TEST(CameraPanini, EdgesHoldTheFieldOfViewAndUprightLinesStayUpright) {
  for (const double width : {60.0, 140.0, 240.0}) {
    const CameraParameters p = wide(width, 10.0);
    const auto camera = make_camera(p);
    EXPECT_NEAR(camera->project(position(p, 0.5 * width, 0.0))->x, 800.0, 1e-6);
    EXPECT_NEAR(camera->project(position(p, -0.5 * width, 0.0))->x, 0.0, 1e-6);
    for (const double turn : {-0.5 * width, -20.0, 13.0, 0.4 * width}) {
      const auto low = camera->project(position(p, turn, -5000.0));
      const auto high = camera->project(position(p, turn, 3000.0));
      ASSERT_TRUE(low && high);
      EXPECT_NEAR(low->x, high->x, 1e-9);
      EXPECT_GT(low->y, high->y + 100.0);
    }
  }
}

TEST(CameraPanini, TheHorizonIsOneRowThatThePitchMoves) {
  for (const double pitch : {-20.0, 0.0, 15.0}) {
    const CameraParameters p = wide(150.0, pitch);
    const auto camera = make_camera(p);
    // A unit is half the width over 2 tan(150° / 4); the central ray rises by the pitch.
    const double unit_px = 400.0 / (2.0 * std::tan(to_radians(37.5)));
    const double row = 200.0 + unit_px * std::tan(to_radians(pitch));
    for (const double turn : {-75.0, -10.0, 0.0, 60.0})
      EXPECT_NEAR(camera->project(position(p, turn, 0.0))->y, row, 1e-6);
    EXPECT_NEAR(camera->ray({130.0, row}).direction.z, 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace belvedere
