#include "renderer/trace/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/angle.h"
#include "base/error.h"

namespace belvedere {
namespace {

CameraParameters base(const std::string& projection) {
  CameraParameters p;
  p.projection = projection;
  p.width = 800;
  p.height = 400;
  p.eye = {692000.0, 5302000.0, 22000.0};
  p.azimuth_deg = 182.0;
  p.pitch_deg = -19.0;
  return p;
}

void expect_near(glm::dvec3 a, glm::dvec3 b, double tolerance) {
  EXPECT_LT(glm::length(a - b), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(Camera, ProjectUndoesRayInEveryProjection) {
  for (const Projection& projection : projections()) {
    for (const double pitch : {-75.0, -19.0, -5.0}) {
      CameraParameters p = base(std::string(projection.name));
      p.pitch_deg = pitch;
      const auto camera = make_camera(p);
      // Positions beyond the picture's edges round-trip as well.
      for (double y = -20.0; y <= 430.0; y += 37.3) {
        for (double x = -30.0; x <= 830.0; x += 41.7) {
          for (const double t : {3.0, 9000.0, 120000.0}) {
            const Ray ray = camera->ray({x, y});
            EXPECT_NEAR(glm::length(ray.direction), 1.0, 1e-14);
            const auto back = camera->project(ray.origin + t * ray.direction);
            ASSERT_TRUE(back) << projection.name;
            // At 3 m the coordinates' own rounding (1e-9 m) is the limit.
            EXPECT_NEAR(back->x, x, 1e-5) << projection.name << " pitch " << pitch;
            EXPECT_NEAR(back->y, y, 1e-5) << projection.name << " pitch " << pitch;
          }
        }
      }
    }
  }
}

// A picture that is cropped on one side shows what the whole shows there.
TEST(Camera, AShiftMovesThePictureAlone) {
  for (const Projection& projection : projections()) {
    const CameraParameters whole = base(std::string(projection.name));
    CameraParameters shifted = whole;
    shifted.shift = {0.1, -0.05};
    const auto a = make_camera(whole);
    const auto b = make_camera(shifted);
    for (const glm::dvec2 pixel : {glm::dvec2(100.0, 350.0), {400.0, 200.0}, {700.0, 50.0}}) {
      const Ray of_whole = a->ray(pixel);
      const Ray of_shifted = b->ray(pixel + glm::dvec2(80.0, -40.0));
      expect_near(of_shifted.direction, of_whole.direction, 1e-12);
      expect_near(of_shifted.origin, of_whole.origin, 1e-6);
    }
  }
}

TEST(Camera, MiddleRayLooksAlongAzimuthAndPitch) {
  for (const Projection& projection : projections()) {
    CameraParameters p = base(std::string(projection.name));
    for (const double azimuth : {0.0, 90.0, 182.0, 315.0}) {
      p.azimuth_deg = azimuth;
      const Ray ray = make_camera(p)->ray({400.0, 200.0});
      const double a = to_radians(azimuth);
      const double b = to_radians(p.pitch_deg);
      expect_near(ray.direction,
                  {std::sin(a) * std::cos(b), std::cos(a) * std::cos(b), std::sin(b)}, 1e-12);
      expect_near(ray.origin, p.eye, 1e-6);
    }
  }
}

TEST(Camera, RightIsClockwiseAndDownIsDown) {
  for (const Projection& projection : projections()) {
    CameraParameters p = base(std::string(projection.name));
    p.azimuth_deg = 0.0;
    const auto camera = make_camera(p);
    const Ray centre = camera->ray({400.0, 200.0});
    const glm::dvec3 ahead = centre.origin + 20000.0 * centre.direction;
    const auto east = camera->project(ahead + glm::dvec3(500.0, 0.0, 0.0));
    const auto lower = camera->project(ahead - glm::dvec3(0.0, 0.0, 500.0));
    ASSERT_TRUE(east && lower);
    EXPECT_GT(east->x, 405.0) << projection.name;
    EXPECT_NEAR(lower->x, 400.0, 1e-6) << projection.name;
    EXPECT_GT(lower->y, 205.0) << projection.name;
  }
}

TEST(Camera, FieldOfViewSpansThePicturesEdges) {
  CameraParameters p = base("perspective");
  p.pitch_deg = 0.0;
  p.azimuth_deg = 0.0;
  const auto perspective = make_camera(p);
  expect_near(perspective->ray({0.0, 200.0}).direction,
              {-std::sin(to_radians(25.0)), std::cos(to_radians(25.0)), 0.0}, 1e-12);
  expect_near(perspective->ray({800.0, 200.0}).direction,
              {std::sin(to_radians(25.0)), std::cos(to_radians(25.0)), 0.0}, 1e-12);

  p.projection = "cylindrical";
  p.field_of_view_deg = 360.0;
  const auto around = make_camera(p);
  expect_near(around->ray({0.0, 200.0}).direction, {0.0, -1.0, 0.0}, 1e-12);
  expect_near(around->ray({200.0, 200.0}).direction, {-1.0, 0.0, 0.0}, 1e-12);
  expect_near(around->ray({800.0, 200.0}).direction, {0.0, -1.0, 0.0}, 1e-12);

  p.projection = "oblique";
  p.pitch_deg = -45.0;
  p.view_width_m = 8000.0;
  const auto oblique = make_camera(p);
  EXPECT_NEAR(oblique->ray({800.0, 7.0}).origin.x - oblique->ray({0.0, 7.0}).origin.x, 8000.0,
              1e-6);
}

TEST(Camera, StraightDownKeepsTheAzimuthOnTop) {
  CameraParameters p = base("perspective");
  p.pitch_deg = -90.0;
  p.azimuth_deg = 90.0;
  const auto camera = make_camera(p);
  expect_near(camera->ray({400.0, 200.0}).direction, {0.0, 0.0, -1.0}, 1e-12);
  const auto east = camera->project(p.eye + glm::dvec3(100.0, 0.0, -1000.0));
  ASSERT_TRUE(east);
  EXPECT_NEAR(east->x, 400.0, 1e-6);
  EXPECT_LT(east->y, 200.0);
}

TEST(Camera, ObliqueIsAMapWithHeightsUpwards) {
  CameraParameters p = base("oblique");
  p.azimuth_deg = 0.0;
  p.pitch_deg = -30.0;
  p.view_width_m = 8000.0;  // 10 m per pixel
  const auto camera = make_camera(p);
  const glm::dvec3 foot = p.eye + glm::dvec3(0.0, 30000.0, -20000.0);
  const auto at = camera->project(foot);
  const auto north = camera->project(foot + glm::dvec3(0.0, 1000.0, 0.0));
  const auto east = camera->project(foot + glm::dvec3(1000.0, 0.0, 0.0));
  const auto summit = camera->project(foot + glm::dvec3(0.0, 0.0, 1000.0));
  ASSERT_TRUE(at && north && east && summit);
  EXPECT_NEAR(at->y - north->y, 100.0, 1e-6);
  EXPECT_NEAR(east->x - at->x, 100.0, 1e-6);
  EXPECT_NEAR(east->y, at->y, 1e-6);
  EXPECT_NEAR(summit->x, at->x, 1e-6);
  EXPECT_NEAR(at->y - summit->y, 100.0 / std::tan(to_radians(30.0)), 1e-6);
  EXPECT_FALSE(camera->project(p.eye + glm::dvec3(0.0, 0.0, 1.0)));
  expect_near(camera->eye(), p.eye - glm::dvec3(0.0, 2000.0, 0.0),
              1e-6);  // lower edge: 200 px of 10 m nearer
}

TEST(Camera, VerticalLinesStayVerticalOnTheCylinder) {
  CameraParameters p = base("cylindrical");
  p.field_of_view_deg = 200.0;
  const auto camera = make_camera(p);
  for (const double bearing : {90.0, 140.0, 182.0, 265.0}) {
    const glm::dvec3 foot = p.eye + 7000.0 * glm::dvec3(std::sin(to_radians(bearing)),
                                                        std::cos(to_radians(bearing)), 0.0);
    const auto low = camera->project(foot - glm::dvec3(0.0, 0.0, 9000.0));
    const auto high = camera->project(foot + glm::dvec3(0.0, 0.0, 2000.0));
    ASSERT_TRUE(low && high);
    EXPECT_NEAR(low->x, high->x, 1e-9);
    EXPECT_NEAR(low->x, 400.0 + (bearing - 182.0) * 4.0, 1e-6);
    // The tangent of the elevation angle is linear in y.
    EXPECT_NEAR(low->y - high->y, 11000.0 / 7000.0 * 800.0 / to_radians(200.0), 1e-6);
  }
}

TEST(Camera, NothingBehindThePerspectiveEye) {
  const CameraParameters p = base("perspective");
  const auto camera = make_camera(p);
  const Ray ray = camera->ray({400.0, 200.0});
  EXPECT_FALSE(camera->project(ray.origin - 10.0 * ray.direction));
  EXPECT_FALSE(camera->project(ray.origin));
}

TEST(Camera, RefusesValuesOutOfRangeNamingTheField) {
  const auto refused = [](auto change, const char* key, const char* projection = "perspective") {
    CameraParameters p = base(projection);
    change(p);
    try {
      make_camera(p);
      ADD_FAILURE() << key << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_THAT(error.where(), testing::HasSubstr(key));
      EXPECT_FALSE(error.allowed().empty());
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](auto& p) { p.width = 15; }, "width");
  refused([](auto& p) { p.height = 65536; }, "height");
  refused([](auto& p) { p.field_of_view_deg = 151.0; }, "field_of_view_deg");
  refused([](auto& p) { p.field_of_view_deg = 361.0; }, "field_of_view_deg", "cylindrical");
  refused([](auto& p) { p.pitch_deg = -91.0; }, "pitch_deg");
  refused([](auto& p) { p.pitch_deg = 0.0; }, "pitch_deg", "oblique");
  refused([](auto& p) { p.pitch_deg = 90.0; }, "pitch_deg", "cylindrical");
  refused([](auto& p) { p.view_width_m = 0.0; }, "view_width_m", "oblique");
  refused([nan](auto& p) { p.azimuth_deg = nan; }, "azimuth_deg");
  refused([nan](auto& p) { p.eye.z = nan; }, "eye.z");
  refused([](auto& p) { p.projection = "fisheye"; }, "projection");
}

}  // namespace
}  // namespace belvedere
