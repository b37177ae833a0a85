#include "renderer/trace/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/error.h"
#include "base/math.h"
#include "tests/files.h"
#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

CameraParameters base(const std::string& projection) {
  return {.projection = projection,
          .width = 800,
          .height = 400,
          .eye = {692000.0, 5302000.0, 22000.0},
          .azimuth_deg = 182.0,
          .pitch_deg = -19.0};
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
    const Error error = test::error_of([&] { make_camera(p); });
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.where(), testing::HasSubstr(key));
    EXPECT_FALSE(error.allowed().empty());
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

CameraParameters wide(double field_of_view_deg, double pitch_deg = 0.0) {
  return {.projection = "panini",
          .width = 800,
          .height = 400,
          .eye = {692000.0, 5302000.0, 2200.0},
          .azimuth_deg = 182.0,
          .pitch_deg = pitch_deg,
          .field_of_view_deg = field_of_view_deg};
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

TEST(ReducedCamera, HasTheRaysOfTheWholePicture) {
  for (const Projection& projection : projections()) {
    const std::unique_ptr<Camera> whole =
        make_camera({.projection = std::string(projection.name), .width = 1001, .height = 600});
    const std::unique_ptr<const Camera> reduced = make_reduced_camera(*whole, 4);
    EXPECT_EQ(reduced->size(), glm::ivec2(251, 150)) << "rounded up";
    const Ray a = whole->ray({400.0, 120.0});
    const Ray b = reduced->ray({100.0, 30.0});
    EXPECT_EQ(a.origin, b.origin) << projection.name;
    EXPECT_EQ(a.direction, b.direction);
    const auto position = reduced->project(b.origin + b.direction * 5000.0);
    ASSERT_TRUE(position.has_value());
    EXPECT_NEAR(position->x, 100.0, 1e-6);
    EXPECT_NEAR(position->y, 30.0, 1e-6);
  }
}

constexpr int factor = 4;

// A level picture whose depth is the same everywhere.
GuidanceBuffers level_view(int width, int height) {
  return test::make_slope(width, height, LandCoverClass::rock, {0.0F, 0.3F, 1.0F}, 45.0F);
}

TEST(WideView, LeavesTwoPixelsToAUnit) {
  EXPECT_EQ(wide_factor(0.3), 1);
  EXPECT_EQ(wide_factor(1.04), 1);
  EXPECT_EQ(wide_factor(3.99), 1);
  EXPECT_EQ(wide_factor(4.0), 2);
  EXPECT_EQ(wide_factor(8.34), 4);
}

TEST(WideView, APixelOfTheSheetLiesInOneOfIts) {
  const GuidanceBuffers g = level_view(10, 6);
  const WideView wide{g, factor, {5, 2}};
  EXPECT_EQ(wide.column(20), 0);
  EXPECT_EQ(wide.column(23), 0);
  EXPECT_EQ(wide.column(24), 1);
  EXPECT_EQ(wide.column(3), 0) << "the nearest there is";
  EXPECT_EQ(wide.column(1000), 9);
  EXPECT_EQ(wide.row(11), 0);
  EXPECT_EQ(wide.row(12), 1);
  EXPECT_TRUE(wide.holds(20, 8));
  EXPECT_TRUE(wide.holds(59, 31));
  EXPECT_FALSE(wide.holds(19, 8));
  EXPECT_FALSE(wide.holds(60, 31));
  EXPECT_FALSE(wide.holds(20, 7));
}

TEST(WideView, ItsRectangleHoldsWhatLiesBetween) {
  for (const PixelRect rect :
       {PixelRect{0, 0, 1, 1}, PixelRect{17, 30, 41, 33}, PixelRect{-9, -4, 8, 3}}) {
    const PixelRect wide = wide_rect(rect, factor);
    EXPECT_LE((wide.x0 + 0.5) * factor, rect.x0 + 0.5);
    EXPECT_LE((wide.y0 + 0.5) * factor, rect.y0 + 0.5);
    EXPECT_GE((wide.x1 - 0.5) * factor, rect.x1 - 0.5);
    EXPECT_GE((wide.y1 - 0.5) * factor, rect.y1 - 0.5);
  }
}

}  // namespace
}  // namespace belvedere
