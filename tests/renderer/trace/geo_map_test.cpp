#include "renderer/trace/geo_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/math.h"
#include "base/random.h"
#include "renderer/trace/guidance.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr double map_cell_m = 30.0;
const GeoTransform frame{650000.0, 5320000.0, map_cell_m, map_cell_m};
const glm::dvec2 viewer(653000.0, 5323000.0);
// A patch of water on a meadow, in the core of the turned area.
const glm::dvec2 mountain(653200.0, 5316500.0);
const glm::dvec2 lake = mountain + glm::dvec2(0.0, 500.0);

glm::dvec2 turned(glm::dvec2 v, double deg) {
  const double c = std::cos(to_radians(deg));
  const double s = std::sin(to_radians(deg));
  return {v.x * c + v.y * s, -v.x * s + v.y * c};
}

DeformParameters everything() {
  DeformParameters p;
  p.exaggeration = 1.6;
  p.background_exaggeration = 1.2;
  p.foreground_to_m = 4000.0;
  p.background_from_m = 9000.0;
  p.bend.points = {{2000.0, std::nullopt, 18.0}, {8000.0, std::nullopt, 0.0}};
  p.summits = {{{652000.0, 5315500.0}, 1500.0, 1.3, 100.0}};
  p.handles = {{.centre = mountain,
                .move_m = {150.0, 80.0},
                .rotate_deg = 50.0,
                .radius_m = 2500.0,
                .core_m = 1000.0}};
  return p;
}

struct SeenGround {
  Deformation deformation;
  TerrainModel terrain;
  DeformedSurface surface;
  std::unique_ptr<Camera> camera;
  std::unique_ptr<Tracer> tracer;

  GeoMap map() const {
    return {terrain.dem->altitude_m,
            terrain.goes_to,
            terrain.dem->transform,
            deformation,
            surface,
            *camera,
            *tracer};
  }
};

std::unique_ptr<SeenGround> make_ground(const DeformParameters& deform_parameters,
                                        double relief_m = 250.0) {
  Raster<float> raster;
  raster.transform = frame;
  raster.cells = Grid<float>(220, 260);
  LandCover cover;
  cover.classes.transform = frame;
  cover.classes.cells = Grid<LandCoverClass>(220, 260, LandCoverClass::alpine_grass);
  for (const auto [x, y] : test::cells(220, 260)) {
    const glm::dvec2 position = frame.to_crs(x, y);
    raster.cells(x, y) = static_cast<float>(
        400.0 + relief_m * gaussian_noise(7, position.x - 650000.0, position.y - 5312000.0, 900.0));
    if (glm::length(position - lake) < 200.0) cover.classes.cells(x, y) = LandCoverClass::water;
  }
  auto world = std::make_unique<SeenGround>();
  Dem dem = make_dem(std::move(raster));
  Grid<float> shown = dem.altitude_m;
  world->deformation = Deformation(deform_parameters, viewer);
  world->surface = deform(shown, frame, glm::dvec3(viewer, 0.0), world->deformation);
  world->terrain = make_terrain_model(std::make_shared<const Dem>(std::move(dem)), std::move(shown),
                                      std::make_shared<const LandCover>(std::move(cover)),
                                      deform_parameters.exaggeration);
  if (world->deformation.is_local()) world->terrain.local = world->deformation;
  CameraParameters camera{.width = 240,
                          .height = 160,
                          .eye = {viewer, 4500.0},
                          .azimuth_deg = 180.0,
                          .pitch_deg = -33.0};
  world->camera = make_camera(camera);
  world->tracer = std::make_unique<Tracer>(world->surface);
  return world;
}

GuidanceBuffers trace_ground(const SeenGround& world) {
  GuidanceParameters parameters;
  parameters.sampling.pixel_samples = 1;
  parameters.sampling.shadow_rays = 1;
  parameters.sampling.sky_directions = 0;
  return trace_guidance(world.terrain, world.surface, *world.tracer, *world.camera, parameters,
                        {0, 0, 240, 160}, silent_progress());
}

TEST(GeoMap, FromPixelToPlaceAndBackIsTheSamePixel) {
  const auto world = make_ground(everything());
  const GeoMap map = world->map();
  int ground = 0;
  for (const auto [x, y] : test::cells({0, 0, 240, 160}, 3)) {
    const glm::dvec2 pixel(x + 0.3, y + 0.7);
    const auto position = map.to_geo(pixel);
    if (!position) continue;
    ++ground;
    const auto back = map.to_image(position->position);
    ASSERT_TRUE(back);
    ASSERT_LT(glm::length(back->pixel - pixel), 0.01) << x << ' ' << y;
    ASSERT_TRUE(back->visible) << x << ' ' << y;
    ASSERT_NEAR(back->distance_m, position->distance_m, 0.5);
  }
  EXPECT_GT(ground, 2000);
  EXPECT_FALSE(map.to_image(glm::dvec2(600000.0, 5316000.0)));
  EXPECT_FALSE(map.to_geo({120.0, -2000.0}));
}

TEST(GeoMap, AgreesWithTheGuidanceBuffers) {
  // The P channel is the undeformed position of the ground in a pixel (at its centre, with one
  // sample per pixel).
  const auto world = make_ground(everything());
  const GeoMap map = world->map();
  const GuidanceBuffers guidance = trace_ground(*world);
  for (const auto [x, y] : test::cells({0, 0, 240, 160}, 5)) {
    if (std::isinf(guidance.depth_m(x, y))) continue;
    const glm::dvec3 position = glm::dvec3(guidance.position_m(x, y)) + guidance.origin_m;
    const auto at = map.to_image(glm::dvec2(position));
    ASSERT_TRUE(at);
    ASSERT_LT(glm::length(at->pixel - glm::dvec2(x + 0.5, y + 0.5)), 0.1) << x << ' ' << y;
    ASSERT_TRUE(at->visible);
    ASSERT_NEAR(map.to_geo({x + 0.5, y + 0.5})->altitude_m,
                static_cast<double>(guidance.altitude_m(x, y)), 0.01);
  }
}

// Ground east of column 100 was drawn 6 cells farther east, as in a widened valley.
TEST(GeoMap, PlacesGoAlongWithGroundThatMoved) {
  const auto world = make_ground({});
  Grid<glm::vec2> goes_to(220, 260);
  for (const auto [x, y] : test::cells(220, 260))
    goes_to(x, y).x = 6.F * static_cast<float>(std::clamp((x - 100) / 30.0, 0.0, 1.0) *
                                               std::clamp((210 - x) / 30.0, 0.0, 1.0));
  const auto map_of = [&](const Grid<glm::vec2>& moves) {
    return GeoMap(world->terrain.dem->altitude_m, moves, frame, world->deformation, world->surface,
                  *world->camera, *world->tracer);
  };
  const Grid<glm::vec2> unmoved;
  const GeoMap map = map_of(goes_to);
  const GeoMap plain = map_of(unmoved);
  const glm::dvec2 position = frame.to_crs(144.0, 150.0);
  const glm::dvec2 drawn = frame.to_crs(150.0, 150.0);
  EXPECT_NEAR(glm::length(map.drawn_position(position) - drawn), 0.0, 0.01 * frame.cell_x);
  EXPECT_NEAR(glm::length(map.position_of_drawn(drawn) - position), 0.0, 0.01);
  ASSERT_TRUE(map.to_image(position) && plain.to_image(drawn) && map.drawn_to_image(drawn));
  EXPECT_LT(glm::length(map.to_image(position)->pixel - plain.to_image(drawn)->pixel), 0.02);
  EXPECT_EQ(map.drawn_to_image(drawn)->pixel, plain.to_image(drawn)->pixel);
  EXPECT_LT(glm::length(map.to_image(glm::dvec3(position, 400.0))->pixel -
                        plain.to_image(glm::dvec3(drawn, 400.0))->pixel),
            0.02);
  for (int y = 40; y < 160; y += 13)
    for (int x = 10; x < 240; x += 17) {
      const auto shown = map.to_geo({x + 0.5, y + 0.5});
      if (!shown) continue;
      ASSERT_LT(glm::length(map.to_image(shown->position)->pixel - glm::dvec2(x + 0.5, y + 0.5)),
                0.1)
          << x << ' ' << y;
    }
}

TEST(GeoMap, APointOnThePostsIsTheSameByAltitudeAndByGround) {
  const auto world = make_ground(everything());
  const GeoMap map = world->map();
  for (int y = 40; y < 240; y += 17)
    for (int x = 10; x < 210; x += 13) {
      const glm::dvec2 position = frame.to_crs(x, y);
      const auto ground = map.to_image(position);
      const auto point = map.to_image(glm::dvec3(position, world->terrain.dem->altitude_m(x, y)));
      ASSERT_TRUE(ground && point);
      ASSERT_LT(glm::length(ground->pixel - point->pixel), 0.01);
      const auto above =
          map.to_image(glm::dvec3(position, world->terrain.dem->altitude_m(x, y) + 50.F));
      ASSERT_LT(above->pixel.y, point->pixel.y);
    }
}

TEST(GeoMap, HiddenGroundIsHidden) {
  // Each position is visible exactly if its pixel shows it and nothing nearer.
  const auto world = make_ground(everything(), 500.0);
  const GeoMap map = world->map();
  int hidden = 0;
  int seen = 0;
  for (const auto [x, y] : test::cells({5, 5, 215, 255}, 4)) {
    const glm::dvec2 position = frame.to_crs(x + 0.25, y + 0.25);
    const auto at = map.to_image(position);
    ASSERT_TRUE(at);
    if (!at->in_picture) {
      ASSERT_FALSE(at->visible);
      continue;
    }
    const auto shown = map.to_geo(at->pixel);
    const bool same = shown && glm::length(shown->position - position) < 1.0;
    ASSERT_EQ(at->visible, same) << x << ' ' << y;
    (same ? seen : hidden) += 1;
  }
  EXPECT_GT(hidden, 50);
  EXPECT_GT(seen, 500);
}

TEST(Deformation, LandCoverFollowsWhatMoves) {
  const auto world = make_ground(everything(), 0.0);
  const GuidanceBuffers guidance = trace_ground(*world);
  // The lake is where the handle moved it: 50° clockwise about the mountain and shifted.
  const glm::dvec2 moved = mountain + glm::dvec2(150.0, 80.0) + turned(lake - mountain, 50.0);
  int water = 0;
  for (const auto [x, y] : test::cells(240, 160)) {
    const Ray ray = world->camera->ray({x + 0.5, y + 0.5});
    const float depth = guidance.depth_m(x, y);
    if (std::isinf(depth)) continue;
    const glm::dvec2 shown(ray.origin + ray.direction * static_cast<double>(depth));
    const double from_lake = glm::length(shown - moved);
    if (from_lake < 150.0) {
      ++water;
      EXPECT_EQ(guidance.land_cover(x, y), LandCoverClass::water);
    }
    if (from_lake > 250.0) {
      EXPECT_EQ(guidance.land_cover(x, y), LandCoverClass::alpine_grass);
    }
    // So is the position itself.
    if (guidance.land_cover(x, y) == LandCoverClass::water) {
      EXPECT_LT(
          glm::length(glm::dvec2(glm::dvec3(guidance.position_m(x, y)) + guidance.origin_m) - lake),
          230.0);
    }
  }
  EXPECT_GT(water, 20);
}

TEST(Deformation, LightFallsOnTheTurnedSlope) {
  // A plane rising to the east, turned by 50°: its normal turns too, and no other channel is bent
  // with the ground.
  DeformParameters p;
  p.exaggeration = 1.5;
  p.bend.points = {{2000.0, std::nullopt, 18.0}, {8000.0, std::nullopt, 0.0}};
  p.handles = {{.centre = mountain, .rotate_deg = 50.0, .radius_m = 2500.0, .core_m = 1000.0}};
  const auto world = make_ground(p, 0.0);
  Grid<float>& z = world->terrain.generalized_m;
  for (const auto [x, y] : test::cells(220, 260))
    z(x, y) = static_cast<float>(0.4 * map_cell_m * x);
  world->terrain.detail_smooth_m = z;
  world->surface = deform(z, frame, glm::dvec3(viewer, 0.0), world->deformation);
  Tracer tracer(world->surface);
  *world->tracer = std::move(tracer);
  const auto at = world->map().to_image(mountain);
  ASSERT_TRUE(at && at->visible);
  const GuidanceBuffers guidance = trace_ground(*world);
  const glm::dvec3 normal(
      guidance.normal(static_cast<int>(at->pixel.x), static_cast<int>(at->pixel.y)));
  // Unturned the normal leans west with slope 0.4 · 1.5.
  const glm::dvec2 lean = turned({-0.6, 0.0}, 50.0);
  EXPECT_LT(glm::length(normal - glm::normalize(glm::dvec3(lean, 1.0))), 1e-3);
  // Slope and aspect are the ground's own, as on the map: neither exaggerated nor turned.
  const std::size_t pixel =
      guidance.slope_deg.index(static_cast<int>(at->pixel.x), static_cast<int>(at->pixel.y));
  EXPECT_NEAR(guidance.slope_deg[pixel], to_degrees(std::atan(0.4)), 0.01);
  EXPECT_NEAR(guidance.aspect_deg[pixel], 270.0, 0.1);
}

}  // namespace
}  // namespace belvedere
