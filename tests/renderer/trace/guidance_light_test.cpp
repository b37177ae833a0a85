// The light of guidance: sky, sun and penumbra.
#include "renderer/trace/guidance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "base/math.h"
#include "renderer/trace/guidance_rays.h"
#include "tests/grids.h"
#include "tests/renderer/trace/synthetic_ground.h"

namespace belvedere {
namespace {

using test::all_meadow;
using test::make_world;
using test::rough_world;
using test::southward;
using test::SyntheticWorld;
using test::trace;

TEST(Guidance, SkyDirectionsAreCosineWeightedAndDealtOutEvenly) {
  for (const int per_pixel : {1, 4, 16}) {
    const auto all = sky_directions(per_pixel);
    ASSERT_EQ(all.size(), static_cast<std::size_t>(16 * per_pixel));
    std::array<int, 16> dealt{};
    glm::dvec3 mean(0.0);
    for (const SkyDirection& d : all) {
      ++dealt[static_cast<std::size_t>(d.lane)];
      EXPECT_NEAR(glm::length(d.direction), 1.0, 1e-12);
      EXPECT_GT(d.direction.z, 0.0);
      mean += d.direction / static_cast<double>(all.size());
    }
    EXPECT_THAT(dealt, testing::Each(per_pixel));
    EXPECT_NEAR(mean.z, 2.0 / 3.0, 0.01);
    EXPECT_NEAR(mean.x, 0.0, 0.05);
    EXPECT_NEAR(mean.y, 0.0, 0.05);
  }
}

TEST(Guidance, SunBelowTheHorizonLeavesAllTerrainInShadow) {
  const SyntheticWorld world = rough_world();
  GuidanceParameters parameters;
  parameters.sun_direction = glm::normalize(glm::dvec3(-0.7, 0.7, -0.05));
  const GuidanceBuffers b = trace(world, *make_camera(southward(64, 48)), parameters);
  for (std::size_t i = 0; i < b.depth_m.size(); ++i)
    EXPECT_EQ(b.shadow[i], b.is_sky(i) ? 1.F : 0.F);
}

// A wall across a plain: the umbra ends where the disc's upper edge passes the crest, the penumbra
// where its lower edge does.
TEST(Guidance, PenumbraOfAWallIsAsWideAsTheDisc) {
  const double wall = 400.0;
  const SyntheticWorld world = make_world(
      300, 300, [&](double, double y) { return y >= 6000.0 && y <= 6030.0 ? wall : 0.0; },
      all_meadow);
  CameraParameters p;
  p.projection = "oblique";  // straight down: a map, 10 m per pixel
  p.pitch_deg = -90.0;
  p.width = 64;
  p.height = 256;
  p.view_width_m = 640.0;
  p.eye = {654500.0, 5320000.0 - 5000.0, 3000.0};
  const auto camera = make_camera(p);
  GuidanceParameters parameters;
  parameters.sampling.shadow_rays = 32;
  parameters.sampling.sky_directions = 0;
  parameters.sun_radius_rad = 0.05;
  const double altitude = to_radians(30.0);
  parameters.sun_direction = {0.0, -std::cos(altitude),
                              std::sin(altitude)};  // from the south: the shadow falls north
  const GuidanceBuffers b = trace(world, *camera, parameters);
  const auto length = [&](double angle) { return wall / std::tan(angle); };
  for (int y = 0; y < b.height(); ++y) {
    double lit = 0.0;
    double from_wall = 0.0;
    for (int x = 0; x < b.width(); ++x) {
      const std::size_t i = b.depth_m.index(x, y);
      lit += b.shadow[i] / b.width();
      from_wall = b.position_m[i].y + world.surface.origin.y - (5320000.0 - 15.0 - 6000.0);
    }
    if (from_wall > length(altitude - 0.05) + 20.0) {
      EXPECT_EQ(lit, 1.0) << from_wall;
    }
    if (from_wall < length(altitude + 0.05) - 20.0 && from_wall > 40.0) {
      EXPECT_EQ(lit, 0.0) << from_wall;
    }
    // In the centre of the penumbra half of the disc is visible.
    if (std::abs(from_wall - length(altitude)) < 6.0) {
      EXPECT_NEAR(lit, 0.5, 0.12);
    }
  }
}

// The same wall under two suns: in the east of the map a region has the sun in the north.
class WallUnderTwoSuns : public testing::Test {
 protected:
  static constexpr double wall = 400.0;
  static constexpr double wall_y = 5320000.0 - 15.0 - 6000.0;
  SyntheticWorld world_ = make_world(
      300, 300, [](double, double y) { return y >= 6000.0 && y <= 6030.0 ? wall : 0.0; },
      all_meadow);
  GuidanceParameters parameters_;
  std::unique_ptr<const Camera> camera_;

  WallUnderTwoSuns() {
    CameraParameters p;
    p.projection = "oblique";  // straight down: a map, 20 m per pixel
    p.pitch_deg = -90.0;
    p.width = 128;
    p.height = 128;
    p.view_width_m = 2560.0;
    p.eye = {654500.0, wall_y, 3000.0};
    camera_ = make_camera(p);
    parameters_.sampling.shadow_rays = 8;
    parameters_.sampling.sky_directions = 0;
    parameters_.sun_radius_rad = 0.01;
    const double altitude = to_radians(30.0);
    parameters_.sun_direction = {0.0, -std::cos(altitude), std::sin(altitude)};
    const LightRegion east{.rings = {{{654500.0, 5300000.0},
                                      {665000.0, 5300000.0},
                                      {665000.0, 5330000.0},
                                      {654500.0, 5330000.0}}},
                           .blend_m = 400.0,
                           .sun_direction = {0.0, std::cos(altitude), std::sin(altitude)}};
    parameters_.light_field =
        std::make_shared<const LightField>(parameters_.sun_direction, glm::dvec2(1.0, 0.0),
                                           std::vector{east}, std::vector<CloudShadow>(), 1);
  }
};

TEST_F(WallUnderTwoSuns, EachSideCastsItsOwnShadow) {
  const GuidanceBuffers b = trace(world_, *camera_, parameters_);
  const double length = wall / std::tan(to_radians(30.0));
  int seen = 0;
  for (std::size_t i = 0; i < b.depth_m.size(); ++i) {
    const double east = b.position_m[i].x + world_.surface.origin.x - 654500.0;
    const double north = b.position_m[i].y + world_.surface.origin.y - wall_y;
    const double from_wall = east > 0.0 ? -north : north;  // on the side away from the sun
    if ((east < 0.0 && east > -420.0) || std::abs(north) < 60.0) continue;
    ++seen;
    if (from_wall > 0.0 && from_wall < length - 40.0) {
      EXPECT_EQ(b.shadow[i], 0.F) << east << " " << north;
    }
    if (from_wall < 0.0 || from_wall > length + 40.0) {
      EXPECT_EQ(b.shadow[i], 1.F) << east << " " << north;
    }
  }
  EXPECT_GT(seen, 5000);
}

TEST_F(WallUnderTwoSuns, PartsAndTilesHaveTheBitsOfTheWhole) {
  const GuidanceBuffers whole = trace(world_, *camera_, parameters_);
  for (const int tile : {8, 64}) {
    parameters_.tile_size = tile;
    const PixelRect part{21, 35, 90, 101};
    const GuidanceBuffers b = trace_guidance(world_.terrain, world_.surface, *world_.tracer,
                                             *camera_, parameters_, part, silent_progress());
    for (const auto [x, y] : test::cells(part))
      ASSERT_EQ(b.shadow(x - part.x0, y - part.y0), whole.shadow(x, y)) << x << " " << y;
  }
}

// Shadows of another sun are traced alone over what is traced already.
TEST_F(WallUnderTwoSuns, ShadowsAloneHaveTheBitsOfTheWhole) {
  for (const int samples : {1, 4}) {
    parameters_.sampling.pixel_samples = samples;
    const GuidanceBuffers whole = trace(world_, *camera_, parameters_);
    const PixelRect part{21, 35, 90, 101};
    const Grid<float> shadow = trace_shadows(world_.terrain, world_.surface, *world_.tracer,
                                             *camera_, parameters_, part, silent_progress());
    for (const auto [x, y] : test::cells(part))
      ASSERT_EQ(shadow(x - part.x0, y - part.y0), whole.shadow(x, y)) << x << " " << y;
  }
}

// A region with the picture's own sun changes nothing, however it is written.
TEST_F(WallUnderTwoSuns, ARegionOfTheSameSunCastsTheSameShadows) {
  const LightRegion same{.centre = {654500.0, wall_y},
                         .radius_m = 900.0,
                         .blend_m = 300.0,
                         .sun_direction = parameters_.sun_direction};
  parameters_.light_field =
      std::make_shared<const LightField>(parameters_.sun_direction, glm::dvec2(1.0, 0.0),
                                         std::vector{same}, std::vector<CloudShadow>(), 1);
  const GuidanceBuffers with = trace(world_, *camera_, parameters_);
  parameters_.light_field = nullptr;
  const GuidanceBuffers without = trace(world_, *camera_, parameters_);
  for (std::size_t i = 0; i < with.shadow.size(); ++i)
    EXPECT_NEAR(with.shadow[i], without.shadow[i], 1e-6F);
}

// The two probing rays per pixel must not change the picture: compared with all rays traced one by
// one.
TEST(Guidance, ShadowsWithoutPenumbraAreFoundByTwoRays) {
  const SyntheticWorld world = rough_world();
  const auto camera = make_camera(southward(160, 96, -18.0));
  GuidanceParameters parameters;
  parameters.sampling.pixel_samples = 1;
  parameters.sampling.sky_directions = 0;
  parameters.sun_direction = glm::normalize(glm::dvec3(-0.7, 0.5, 0.35));
  const GuidanceBuffers b = trace(world, *camera, parameters);
  double difference = 0.0;
  int ground = 0;
  int partly = 0;
  const auto positions = disc_positions(64);
  for (const auto [x, y] : test::cells(b)) {
    const std::size_t i = b.depth_m.index(x, y);
    if (b.is_sky(i)) continue;
    ++ground;
    partly += b.shadow[i] > 0.F && b.shadow[i] < 1.F ? 1 : 0;
    const Ray ray = camera->ray({x + 0.5, y + 0.5});
    Hit hit;
    world.tracer->intersect({&ray, 1}, {&hit, 1});
    const glm::dvec3 start =
        ray.origin + ray.direction * hit.distance_m + 0.05 * hit.facet_normal();
    const glm::dvec3 side =
        glm::normalize(glm::cross(parameters.sun_direction, glm::dvec3(0, 0, 1)));
    const glm::dvec3 above = glm::cross(side, parameters.sun_direction);
    std::vector<Ray> rays;
    for (const glm::dvec2 p : positions)
      rays.push_back(
          {start, glm::normalize(parameters.sun_direction + 0.03 * (side * p.x + above * p.y))});
    std::vector<std::uint8_t> blocked(rays.size());
    world.tracer->occluded(rays, 1e9, blocked);
    const auto free = std::count(blocked.begin(), blocked.end(), 0);
    difference += std::abs(static_cast<double>(free) / 64.0 - b.shadow[i]);
  }
  EXPECT_GT(partly, 100);
  EXPECT_LT(difference / ground, 0.012);
}

}  // namespace
}  // namespace belvedere
