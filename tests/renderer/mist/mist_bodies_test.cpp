#include "renderer/mist/mist_bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr double cell = 60.0;

// A valley that runs north: floor 1 km wide at 800 m, sides that rise by 60 in 100 to 2000 m.
double valley_m(double east) {
  return 800.0 + 0.6 * std::min(2000.0, std::max(0.0, std::abs(east - 9000.0) - 500.0));
}

MistGround valley_ground(bool floors = true) {
  const Grid<float> altitude =
      test::grid_of(300, 300, [&](int x, int) { return valley_m((x + 0.5) * cell); });
  const Grid<float> rim(300, 300, 1e6F);
  return make_mist_ground(altitude, rim, {0.0, 18000.0, cell, cell}, floors);
}

TEST(MistBed, ASeaLiesAtItsAltitude) {
  const MistGround ground = valley_ground(false);
  MistBed bed({.to_m = 1400.0, .position = {}}, ground, 0.0, 1);
  EXPECT_EQ(bed.highest_m(), 1400.0);
  for (const double x : {100.0, 9000.0, 15000.0}) {
    EXPECT_EQ(bed.at({x, 5000.0}).top_m, 1400.0);
    EXPECT_EQ(bed.at({x, 5000.0}).cover, 1.0);
  }
}

TEST(MistBed, ASeaEndsAtItsRadiusAndBeforeTheEndOfTheTerrain) {
  MistGround ground = valley_ground(false);
  MistBed round({.to_m = 1400.0, .position = glm::dvec2(9000.0, 9000.0), .radius_m = 4000.0},
                ground, 0.0, 1);
  EXPECT_EQ(round.at({9000.0, 11900.0}).cover, 1.0);
  EXPECT_EQ(round.at({9000.0, 13001.0}).cover, 0.0);
  for (float& rim : ground.rim_m) rim = 1000.0F;
  MistBed rimmed({.to_m = 1400.0, .position = {}}, ground, 2000.0, 1);
  EXPECT_NEAR(rimmed.at({9000.0, 9000.0}).cover, 0.5, 1e-6);
}

TEST(MistBed, MistOfValleysLiesOnTheirFloorsAlone) {
  const MistGround ground = valley_ground();
  MistBed bed({.kind = MistKind::valley, .height_m = 150.0, .patches = 0.0, .position = {}}, ground,
              0.0, 1);
  const MistBed::Column floor = bed.at({9000.0, 9000.0});
  EXPECT_NEAR(floor.top_m, 800.0 + 150.0, 25.0);
  EXPECT_GT(floor.cover, 0.8);
  const MistBed::Column slope = bed.at({10600.0, 9000.0});
  EXPECT_TRUE(slope.cover < 0.05 || slope.top_m < valley_m(10600.0))
      << slope.cover << " " << slope.top_m;
  const MistBed::Column high = bed.at({15500.0, 9000.0});
  EXPECT_LT(high.cover, 0.2) << "a plateau is no valley";
  EXPECT_LE(floor.top_m, bed.highest_m());
}

TEST(MistBed, PatchesTearIt) {
  const MistGround ground = valley_ground();
  const auto covered = [&](double patches) {
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      MistBed bed({.kind = MistKind::valley, .height_m = 150.0, .patches = patches, .position = {}},
                  ground, 0.0, seed);
      for (int k = 0; k < 170; ++k)
        sum += bed.at({9000.0, 500.0 + 100.0 * k}).cover / (12.0 * 170.0);
    }
    return sum;
  };
  EXPECT_GT(covered(0.0), 0.8);
  EXPECT_LT(covered(0.6), 0.75 * covered(0.0));
  EXPECT_LT(covered(0.95), covered(0.6));
}

constexpr double no_ground = std::numeric_limits<double>::infinity();
const glm::dvec3 sun(0.0, -0.6, 0.8);

// Looks north at a summit 10 km away, 2000 m high, in 400 × 200 pixels.
struct Scenery {
  explicit Scenery(double wind_from_deg, double ahead_m = 10000.0) {
    const CameraParameters p{.width = 400,
                             .height = 200,
                             .eye = {0.0, 0.0, 2200.0},
                             .pitch_deg = 0.0,
                             .field_of_view_deg = 60.0};
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
    for (const auto [x, y] : test::cells(400, 200)) {
      const glm::dvec2 pixel(x + 0.5, y + 0.5);
      const LeeSight sight = see_lee_cloud(*cloud, edges, camera->ray(pixel), pixel, depth_m, sun);
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
  for (const auto [x, y] : test::cells(400, 200)) {
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
    for (const auto [x, y] : test::cells({200, 0, 400, 200})) {
      const glm::dvec2 pixel(x + 0.5, y + 0.5);
      const LeeSight sight = see_lee_cloud(*scenery.cloud, edges, scenery.camera->ray(pixel), pixel,
                                           no_ground, towards_sun);
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
