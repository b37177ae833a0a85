#include "renderer/mist/lee_cloud.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

namespace belvedere {
namespace {

constexpr double no_ground = std::numeric_limits<double>::infinity();
const glm::dvec3 sun(0.0, -0.6, 0.8);

// Looks north at a summit 10 km away, 2000 m high, in 400 × 200 pixels.
struct Scenery {
  explicit Scenery(double wind_from_deg, double ahead_m = 10000.0) {
    CameraParameters p;
    p.width = 400;
    p.height = 200;
    p.eye = {0.0, 0.0, 2200.0};
    p.pitch_deg = 0.0;
    p.field_of_view_deg = 60.0;
    camera = make_camera(p);
    cloud = make_lee_cloud({.kind = MistKind::lee,
                            .position = glm::dvec2(0.0, ahead_m),
                            .size_m = 3000.0,
                            .wind_from_deg = wind_from_deg},
                           2000.0, deformation, *camera, 11);
  }
  // Sum of the shares left and right of the summit.
  glm::dvec2 shares(double depth_m) const {
    LeeEdges edges(*cloud);
    glm::dvec2 sum(0.0);
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 400; ++x) {
        const glm::dvec2 pixel(x + 0.5, y + 0.5);
        const LeeSight sight =
            see_lee_cloud(*cloud, edges, camera->ray(pixel), pixel, depth_m, sun);
        (x < 200 ? sum.x : sum.y) += static_cast<double>(sight.share);
      }
    return sum;
  }
  std::unique_ptr<Camera> camera;
  Deformation deformation;
  std::optional<LeeCloud> cloud;
};

TEST(LeeCloud, LiesWhereTheWindGoes) {
  const glm::dvec2 east = Scenery(270.0).shares(no_ground);
  const glm::dvec2 west = Scenery(90.0).shares(no_ground);
  EXPECT_GT(east.y, 100.0);
  EXPECT_GT(east.y, 5.0 * east.x);
  EXPECT_GT(west.x, 5.0 * west.y);
}

TEST(LeeCloud, NearerGroundHidesItAndFartherGroundDoesNot) {
  const Scenery scenery(270.0);
  const glm::dvec2 all = scenery.shares(no_ground);
  EXPECT_EQ(scenery.shares(7000.0), glm::dvec2(0.0));
  EXPECT_EQ(scenery.shares(20000.0), all);
  const double cut = scenery.shares(10000.0).y;
  EXPECT_GT(cut, 0.1 * all.y);
  EXPECT_LT(cut, 0.9 * all.y) << "a slope through its centre";
}

TEST(LeeCloud, ItsBoxHoldsAllOfIt) {
  const Scenery scenery(250.0);
  LeeEdges edges(*scenery.cloud);
  LeeCloud open = *scenery.cloud;
  open.from_px = glm::dvec2(-1e9);
  open.to_px = glm::dvec2(1e9);
  LeeEdges same(open);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 400; ++x) {
      const glm::dvec2 pixel(x + 0.5, y + 0.5);
      const Ray ray = scenery.camera->ray(pixel);
      EXPECT_EQ(see_lee_cloud(*scenery.cloud, edges, ray, pixel, no_ground, sun).share,
                see_lee_cloud(open, same, ray, pixel, no_ground, sun).share);
    }
}

TEST(LeeCloud, IsLitFromTheSunsSide) {
  const Scenery scenery(0.0);
  LeeEdges edges(*scenery.cloud);
  const auto mean_light = [&](glm::dvec3 towards_sun) {
    double light = 0.0, share = 0.0;
    for (int y = 0; y < 200; ++y)
      for (int x = 200; x < 400; ++x) {
        const glm::dvec2 pixel(x + 0.5, y + 0.5);
        const LeeSight sight = see_lee_cloud(*scenery.cloud, edges, scenery.camera->ray(pixel),
                                             pixel, no_ground, towards_sun);
        light += static_cast<double>(sight.share * sight.light);
        share += static_cast<double>(sight.share);
      }
    return light / share;
  };
  EXPECT_GT(mean_light({0.9, 0.0, 0.43}), mean_light({-0.9, 0.0, 0.43}) + 0.05);
}

TEST(LeeCloud, BehindTheEyeThereIsNone) {
  EXPECT_FALSE(Scenery(270.0, -10000.0).cloud.has_value());
}

}  // namespace
}  // namespace belvedere
