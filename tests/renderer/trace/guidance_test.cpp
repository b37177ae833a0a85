#include "renderer/trace/guidance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>
#include <set>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.h"
#include "base/guidance_buffers.h"
#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/trace/guidance_rays.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/renderer/trace/synthetic_ground.h"

namespace belvedere {
namespace {

using test::all_meadow;
using test::cell;
using test::make_world;
using test::rough_world;
using test::southward;
using test::SyntheticWorld;
using test::trace;

TEST(Guidance, PixelPlacesShareNoColumnAndNoRow) {
  for (const int n : {1, 4, 9, 16}) {
    const auto positions = pixel_sample_positions(n);
    ASSERT_EQ(positions.size(), static_cast<std::size_t>(n));
    std::set<int> columns;
    std::set<int> rows;
    for (const glm::dvec2 p : positions) {
      columns.insert(static_cast<int>(std::floor(p.x * n)));
      rows.insert(static_cast<int>(std::floor(p.y * n)));
      EXPECT_NEAR(p.x * n - std::floor(p.x * n), 0.5, 1e-9);
    }
    EXPECT_EQ(columns.size(), static_cast<std::size_t>(n));
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(n));
    EXPECT_GE(*columns.begin(), 0);
    EXPECT_LT(*columns.rbegin(), n);
  }
}

TEST(Guidance, LevelGroundIsLitOpenAndFlat) {
  const SyntheticWorld world = make_world(
      200, 200, [](double, double) { return 500.0; }, all_meadow);
  const GuidanceBuffers b = trace(world, *make_camera(southward(96, 64)));
  int ground = 0;
  for (std::size_t i = 0; i < b.depth_m.size(); ++i) {
    if (b.is_sky(i)) continue;
    ++ground;
    EXPECT_EQ(b.shadow[i], 1.F);
    EXPECT_EQ(b.sky_view[i], 1.F);
    EXPECT_EQ(b.slope_deg[i], 0.F);
    EXPECT_EQ(b.fall_line[i], glm::vec2(0.F));
    EXPECT_EQ(b.normal[i], glm::vec3(0.F, 0.F, 1.F));
    EXPECT_FLOAT_EQ(b.altitude_m[i], 500.F);
    EXPECT_EQ(b.land_cover[i], LandCoverClass::alpine_grass);
    EXPECT_NEAR(b.ridge[i], 0.F, 1e-4);  // the blurs' rounding
    EXPECT_NEAR(b.valley_height_m[i], 0.F, 1e-3);
  }
  EXPECT_GT(ground, 2000);
}

// The distance to the border of the data, or to a void that reaches it; a void inside the terrain
// is filled and counts as ground.
TEST(Guidance, RimIsTheDistanceToTheEndOfTheKnownTerrain) {
  constexpr int side = 200;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto void_at = [](double x, double y, double x0, double x1, double y0, double y1) {
    return x >= x0 * cell && x <= x1 * cell && y >= y0 * cell && y <= y1 * cell;
  };
  const SyntheticWorld world = make_world(
      side, side,
      [&](double x, double y) {
        const bool bay = void_at(x, y, 0, 60, 70, 90);        // from the western border inwards
        const bool hole = void_at(x, y, 120, 130, 100, 110);  // inside known terrain
        return bay || hole ? nan : 500.0;
      },
      all_meadow);
  const GuidanceBuffers b = trace(world, *make_camera(southward(128, 96, -35.0)));
  int ground = 0;
  int at_bay = 0;
  int exact = 0;
  int in_hole = 0;
  for (std::size_t i = 0; i < b.depth_m.size(); ++i) {
    if (b.is_sky(i)) continue;
    const glm::dvec3 position = glm::dvec3(b.position_m[i]) + world.surface.origin;
    const glm::dvec2 at = world.terrain.dem->transform.to_cell(position.x, position.y);
    std::array<double, 4> sides = {at.x, at.y, side - 1 - at.x, side - 1 - at.y};
    std::sort(sides.begin(), sides.end());
    const double border = sides[0];
    const double bay =
        std::hypot(std::max(at.x - 60.0, 0.0), std::max({70.0 - at.y, at.y - 90.0, 0.0}));
    const double expected = cell * std::max(0.0, std::min(border, bay));
    // Bilinear between posts: exact along a straight side, up to half a cell off around corners and
    // where two edges are equally near.
    const bool one_side = std::min(sides[1], bay) > border + 2.0;
    ASSERT_NEAR(b.rim_m[i], expected, one_side ? 0.05 : 0.75 * cell) << at.x << ", " << at.y;
    exact += one_side ? 1 : 0;
    ++ground;
    at_bay += bay < border ? 1 : 0;
    in_hole += at.x > 121 && at.x < 129 && at.y > 101 && at.y < 109 ? 1 : 0;
  }
  EXPECT_GT(ground, 5000);
  EXPECT_GT(at_bay, 300);
  EXPECT_GT(exact, 1000);
  EXPECT_GT(in_hole, 5);
}

TEST(Guidance, SkyPixelsHoldTheirDefaults) {
  const SyntheticWorld world = make_world(
      100, 100, [](double, double) { return 500.0; }, all_meadow);
  const GuidanceBuffers b = trace(world, *make_camera(southward(64, 32, 20.0)));
  for (std::size_t i = 0; i < b.depth_m.size(); ++i) {
    ASSERT_TRUE(b.is_sky(i));
    EXPECT_EQ(b.land_cover[i], LandCoverClass::sky);
    EXPECT_EQ(b.normal[i], glm::vec3(0.F, 0.F, 1.F));
    EXPECT_EQ(b.coverage[i], 0.F);
    EXPECT_EQ(b.front[i], 1.F);
    EXPECT_EQ(b.shadow[i], 1.F);
    EXPECT_EQ(b.sky_view[i], 1.F);
    EXPECT_EQ(b.altitude_m[i], 0.F);
  }
}

// A ramp that rises to the south-east: everything has a closed form.
TEST(Guidance, RampHasItsSlopeAspectNormalsAndSkyView) {
  const double east = 0.15;
  const double south = 0.25;
  DeformParameters d;
  d.exaggeration = 1.6;
  const SyntheticWorld world = make_world(
      400, 400, [&](double x, double y) { return 100.0 + east * x + south * y; }, all_meadow, d);
  CameraParameters p = southward(160, 96, -30.0);
  p.eye.z = 6000.0;
  const auto camera = make_camera(p);
  GuidanceParameters parameters;
  parameters.sampling.sky_directions = 64;
  const GuidanceBuffers b = trace(world, *camera, parameters);
  // Gradients point uphill: to the east, and to the south, which is against north.
  const glm::dvec3 normal = glm::normalize(glm::dvec3(-1.6 * east, 1.6 * south, 1.0));
  const glm::dvec3 detail = glm::normalize(glm::dvec3(-2.4 * east, 2.4 * south, 1.0));
  int inner = 0;
  for (std::size_t i = 0; i < b.depth_m.size(); ++i) {
    if (b.is_sky(i)) continue;
    const glm::dvec3 position = glm::dvec3(b.position_m[i]) + world.surface.origin;
    const glm::dvec2 at = world.terrain.dem->transform.to_cell(position.x, position.y);
    if (at.x < 70.0 || at.y < 70.0 || at.x > 330.0 || at.y > 330.0)
      continue;  // the Gaussians reach the border
    ++inner;
    ASSERT_NEAR(b.slope_deg[i], to_degrees(std::atan(std::hypot(east, south))), 0.05);
    ASSERT_NEAR(b.aspect_deg[i], 360.0 - to_degrees(std::atan2(east, south)),
                0.1);  // downhill: north-west
    ASSERT_LT(glm::length(glm::dvec3(b.normal[i]) - normal), 1e-3);
    ASSERT_LT(glm::length(glm::dvec3(b.normal_smooth[i]) - normal), 1e-3);
    ASSERT_LT(glm::length(glm::dvec3(b.normal_detail[i]) - detail), 1e-3);
    ASSERT_NEAR(b.altitude_m[i], 100.0 + (east * at.x + south * at.y) * cell, 0.01);
    ASSERT_NEAR(position.z, b.altitude_m[i], 0.01);
    // A tilted plane has a sky view of (1 + cos tilt) / 2 with cosine weights.
    ASSERT_NEAR(b.sky_view[i], 0.5 * (1.0 + normal.z), 0.02);
    ASSERT_NEAR(b.relief_m_m[i], 0.0, 0.5);
    // The fall line goes left (west is right when looking south, so downhill west is to the right)
    // and down (towards the viewer).
    ASSERT_GT(b.fall_line[i].x, 0.1F);
    ASSERT_GT(b.fall_line[i].y, 0.1F);
    ASSERT_NEAR(glm::length(b.fall_line[i]), 1.0, 1e-5);
  }
  EXPECT_GT(inner, 1500);
}

TEST(Guidance, PlacesProjectBackIntoTheirPixels) {
  const SyntheticWorld world = rough_world();
  for (const char* projection : {"perspective", "oblique", "cylindrical"}) {
    CameraParameters p = southward(200, 120, -30.0);
    p.projection = projection;
    p.view_width_m = 6000.0;
    p.field_of_view_deg = 60.0;
    p.eye.z = 6500.0;
    const auto camera = make_camera(p);
    const GuidanceBuffers b = trace(world, *camera);
    int ground = 0;
    for (const auto [x, y] : test::cells(b)) {
      const std::size_t i = b.depth_m.index(x, y);
      if (b.is_sky(i)) continue;
      ++ground;
      const glm::dvec3 position = glm::dvec3(b.position_m[i]) + world.surface.origin;
      const auto at =
          camera->project(Deformation(world.deform_parameters, world.viewer).point(position));
      ASSERT_TRUE(at);
      // Inside the pixel; a facet differs from the bilinear altitude by up to some decimetres.
      ASSERT_NEAR(at->x, x + 0.5, 0.6) << projection;
      ASSERT_NEAR(at->y, y + 0.5, 0.8) << projection;
    }
    EXPECT_GT(ground, 5000) << projection;
  }
}

TEST(Guidance, FootprintIsMetresAPixel) {
  const SyntheticWorld world = rough_world();
  CameraParameters p = southward(120, 80, -30.0);
  p.eye.z = 6500.0;
  p.projection = "oblique";
  p.view_width_m = 6000.0;
  const GuidanceBuffers map = trace(world, *make_camera(p));
  p.projection = "perspective";
  const GuidanceBuffers view = trace(world, *make_camera(p));
  for (std::size_t i = 0; i < map.depth_m.size(); ++i)
    if (!map.is_sky(i)) {
      ASSERT_NEAR(map.footprint_m[i], 50.0, 1e-3);
    }
  const std::size_t centre = view.depth_m.index(60, 40);
  ASSERT_FALSE(view.is_sky(centre));
  EXPECT_NEAR(view.footprint_m[centre],
              view.depth_m[centre] * 2.0 * std::tan(to_radians(25.0)) / 120.0,
              0.01 * view.footprint_m[centre]);
}

TEST(Guidance, FallLineFollowsTheSlopeInThePicture) {
  // Ramps to the four directions, seen from the north looking south: east is left.
  const struct {
    double dx, dy;  // downhill in metres east and south
    glm::vec2 image;
  } cases[] = {{1.0, 0.0, {-1.F, 0.F}}, {-1.0, 0.0, {1.F, 0.F}}, {0.0, -1.0, {0.F, 1.F}}};
  for (const auto& c : cases) {
    const SyntheticWorld world = make_world(
        200, 200, [&](double x, double y) { return 1000.0 - 0.2 * (c.dx * x + c.dy * y); },
        all_meadow);
    const GuidanceBuffers b = trace(world, *make_camera(southward(64, 48, -25.0)));
    const std::size_t centre = b.depth_m.index(32, 24);
    ASSERT_FALSE(b.is_sky(centre));
    EXPECT_GT(glm::dot(b.fall_line[centre], c.image), 0.7F) << c.dx << ' ' << c.dy;
  }
}

TEST(Guidance, MostSamplesWinThePixelAndItsValuesComeFromOneOfThem) {
  const SyntheticWorld world = rough_world();
  CameraParameters p = southward(120, 72, -14.0);
  const auto camera = make_camera(p);
  GuidanceParameters parameters;
  parameters.sampling.sky_directions = 0;
  parameters.sampling.shadow_rays = 1;
  const GuidanceBuffers b = trace(world, *camera, parameters);
  const auto positions = pixel_sample_positions(4);
  int mixed = 0;
  int edges = 0;
  for (int y = 0; y < b.height(); ++y)
    for (int x = 0; x < b.width(); ++x) {
      const std::size_t i = b.depth_m.index(x, y);
      std::array<int, land_cover_class_count> votes{};
      std::vector<std::pair<LandCoverClass, double>> seen;
      for (const glm::dvec2 position : positions) {
        const Ray ray = camera->ray(glm::dvec2(x, y) + position);
        Hit hit;
        world.tracer->intersect({&ray, 1}, {&hit, 1});
        const glm::dvec2 at = world.terrain.dem->transform.to_crs(hit.column, hit.row);
        seen.emplace_back(
            hit.found ? world.terrain.land_cover->at(at.x, at.y) : LandCoverClass::sky,
            hit.found ? hit.distance_m : std::numeric_limits<double>::infinity());
        ++votes[static_cast<std::size_t>(seen.back().first)];
      }
      const auto winner =
          static_cast<LandCoverClass>(std::max_element(votes.begin(), votes.end()) - votes.begin());
      ASSERT_EQ(b.land_cover[i], winner) << x << ' ' << y;
      const double depth = b.depth_m[i];
      EXPECT_TRUE(std::any_of(seen.begin(), seen.end(), [&](const auto& s) {
        return s.first == winner && static_cast<float>(s.second) == depth;
      }));
      EXPECT_FLOAT_EQ(b.coverage[i], 1.F - static_cast<float>(votes[0]) / 4.F);
      const auto together = std::count_if(seen.begin(), seen.end(), [&](const auto& s) {
        return winner == LandCoverClass::sky ? s.first == LandCoverClass::sky
                                             : std::abs(s.second - depth) <= 0.03 * depth;
      });
      EXPECT_FLOAT_EQ(b.front[i], static_cast<float>(together) / 4.F);
      mixed += *std::max_element(votes.begin(), votes.end()) < 4 ? 1 : 0;
      edges += b.front[i] < 1.F ? 1 : 0;
    }
  EXPECT_GT(mixed, 100);
  EXPECT_GT(edges, 50);
}

template <class T>
void expect_same(const Grid<T>& whole, const Grid<T>& part, PixelRect region, PixelRect keep,
                 std::string_view channel) {
  ASSERT_EQ(part.width(), region.width()) << channel;
  ASSERT_EQ(part.height(), region.height()) << channel;
  for (const auto [x, y] : test::cells(keep))
    ASSERT_EQ(std::memcmp(&whole(x, y), &part(x - region.x0, y - region.y0), sizeof(T)), 0)
        << channel << " at " << x << ' ' << y;
}

// inner: where the channels that read neighbours are the same.
void expect_same_buffers(const GuidanceBuffers& whole, const GuidanceBuffers& part,
                         PixelRect region, PixelRect inner) {
  for (const GuidanceChannel& channel : guidance_channels()) {
    if (channel.maker != ChannelMaker::trace) continue;
    const bool local = channel.member != GuidanceMember(&GuidanceBuffers::sky_view) &&
                       channel.member != GuidanceMember(&GuidanceBuffers::silhouette);
    std::visit(
        [&](auto member) {
          expect_same(whole.*member, part.*member, region, local ? region : inner,
                      channel.names[0]);
        },
        channel.member);
  }
}

TEST(Guidance, TracesTheChannelsOfItsShareOfTheTableAndNoOthers) {
  const SyntheticWorld world = make_world(
      20, 20, [](double, double) { return 0.0; }, all_meadow);
  const GuidanceBuffers b = trace(world, *make_camera(southward(16, 16)));
  for (const GuidanceChannel& channel : guidance_channels())
    EXPECT_EQ(has_channel(b, channel.member), channel.maker == ChannelMaker::trace)
        << channel.names[0];
}

TEST(Guidance, AnyRectangleTileSizeAndThreadCountGivesTheSameBits) {
  const SyntheticWorld world = rough_world();
  const auto camera = make_camera(southward(131, 77, -16.0));  // no multiple of a block
  GuidanceBuffers whole;
  {
    const ThreadLimit limit(1);
    whole = trace(world, *camera);
  }
  GuidanceParameters parameters;
  for (const int tile : {8, 64}) {
    const ThreadLimit limit(2);
    parameters.tile_size = tile;
    expect_same_buffers(whole, trace(world, *camera, parameters), {0, 0, 131, 77}, {0, 0, 131, 77});
  }
  for (const PixelRect region : {PixelRect{0, 0, 61, 77}, PixelRect{13, 5, 131, 40},
                                 PixelRect{50, 33, 59, 42}, PixelRect{128, 70, 131, 77}}) {
    const GuidanceBuffers part = trace_guidance(world.terrain, world.surface, *world.tracer,
                                                *camera, parameters, region, silent_progress());
    const int m = guidance_margin_px();
    const PixelRect inner = {region.x0 == 0 ? 0 : region.x0 + m, region.y0 == 0 ? 0 : region.y0 + m,
                             region.x1 == 131 ? 131 : region.x1 - m,
                             region.y1 == 77 ? 77 : region.y1 - m};
    expect_same_buffers(whole, part, region, inner);
  }
}

TEST(Guidance, RefusesParametersOutOfRange) {
  const SyntheticWorld world = make_world(
      20, 20, [](double, double) { return 0.0; }, all_meadow);
  const auto camera = make_camera(southward(16, 16));
  const auto refused = [&](auto change, const char* key) {
    GuidanceParameters parameters;
    change(parameters);
    const Error error = test::error_of([&] { trace(world, *camera, parameters); });
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.where(), testing::HasSubstr(key));
  };
  refused([](auto& p) { p.sampling.pixel_samples = 5; }, "pixel_samples");
  refused([](auto& p) { p.sampling.shadow_rays = 0; }, "shadow_rays");
  refused([](auto& p) { p.sampling.sky_directions = 300; }, "sky_directions");
  refused([](auto& p) { p.sampling.sky_reach_m = -1.0; }, "sky_reach_m");
  refused([](auto& p) { p.sun_radius_rad = std::numeric_limits<double>::quiet_NaN(); },
          "sun_radius_rad");
  refused([](auto& p) { p.sun_direction = glm::dvec3(0.0); }, "sun");
  EXPECT_THROW(trace_guidance(world.terrain, world.surface, *world.tracer, *camera, {},
                              {0, 0, 17, 16}, silent_progress()),
               Error);
}

constexpr float sky_m = std::numeric_limits<float>::infinity();

// Depth along the ray of a perspective picture for a level plain, the eye 500 m above it, the
// horizon at row `horizon`; 1000 pixels of focal length; columns from -width/2.
Grid<float> plain(int width, int height, double horizon) {
  Grid<float> depth(width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    const double down = (y + 0.5 - horizon) / 1000.0;
    const double side = (x + 0.5 - width / 2.0) / 1000.0;
    depth(x, y) =
        down > 0.0 ? static_cast<float>(500.0 / down * std::sqrt(1.0 + down * down + side * side))
                   : sky_m;
  }
  return depth;
}

TEST(Silhouettes, AGrazingPlaneHasNone) {
  // The horizon is just above the picture: from one row to the next the depth falls to a third.
  const Grid<float> depth = plain(80, 60, -0.01);
  EXPECT_GT(depth(40, 0) / depth(40, 1), 2.5F);
  const Grid<float> found = find_silhouettes(depth);
  for (const auto [x, y] : test::cells(80, 60)) ASSERT_LT(found(x, y), 0.01F) << x << ' ' << y;
}

TEST(Silhouettes, ATiltedWallHasNone) {
  // A wall seen almost edge-on, its inverse depth linear along x and y.
  const Grid<float> depth =
      test::grid_of(100, 30, [&](int x, int y) { return 1.0 / (1e-5 + 2e-6 * x + 1e-6 * y); });
  const Grid<float> found = find_silhouettes(depth);
  EXPECT_LT(*std::max_element(found.begin(), found.end()), 0.01F);
}

TEST(Silhouettes, AStepMarksItsNearSideOnly) {
  Grid<float> depth(20, 20, 2000.F);
  for (const auto [x, y] : test::cells({0, 8, 20, 20})) depth(x, y) = 1000.F;
  const Grid<float> found = find_silhouettes(depth);
  for (const auto [x, y] : test::cells(20, 20))
    EXPECT_EQ(found(x, y), y == 8 ? 1.F : 0.F) << x << ' ' << y;
}

TEST(Silhouettes, AreFoundTowardsEachOfTheFourSides) {
  Grid<float> depth(9, 9, 5000.F);
  depth(4, 4) = 3000.F;
  const Grid<float> found = find_silhouettes(depth);
  EXPECT_EQ(std::count_if(found.begin(), found.end(), [](float v) { return v > 0.F; }), 1);
  EXPECT_EQ(found(4, 4), 1.F);
  for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    Grid<float> half(9, 9, 5000.F);
    for (const auto [x, y] : test::cells(9, 9))
      if ((x - 4) * dx + (y - 4) * dy <= 0) half(x, y) = 3000.F;
    EXPECT_EQ(find_silhouettes(half)(4, 4), 1.F) << dx << ' ' << dy;
  }
}

TEST(Silhouettes, StrengthIsFourteenTimesTheLogRatio) {
  for (const double ratio : {1.01, 1.03, 1.06, 1.0742, 1.2}) {
    Grid<float> depth(10, 10, 1000.F);
    for (const auto [x, y] : test::cells(10, 5)) depth(x, y) = static_cast<float>(1000.0 * ratio);
    EXPECT_NEAR(find_silhouettes(depth)(5, 5), std::min(1.0, 14.0 * std::log(ratio)), 1e-4)
        << ratio;
  }
}

TEST(Silhouettes, EverythingIsNearerThanTheSky) {
  const Grid<float> found = find_silhouettes(plain(30, 40, 20.0));
  for (int x = 0; x < 30; ++x) {
    EXPECT_EQ(found(x, 20), 1.F);
    EXPECT_EQ(found(x, 19), 0.F);
    EXPECT_LT(found(x, 25), 0.01F);
  }
  const Grid<float> nothing = find_silhouettes(Grid<float>(5, 5, sky_m));
  EXPECT_EQ(*std::max_element(nothing.begin(), nothing.end()), 0.F);
}

TEST(Silhouettes, AHillAgainstAGrazingPlainIsOne) {
  // The plain again, with a near hill in front of its lower half, rounded so that its crest is
  // grazing as well.
  Grid<float> depth = plain(60, 60, 5.0);
  for (const auto [x, y] : test::cells({0, 30, 60, 60}))
    depth(x, y) = 6000.F + 400.F / static_cast<float>(y - 29);
  const Grid<float> found = find_silhouettes(depth);
  for (int x = 0; x < 60; ++x) {
    EXPECT_GT(found(x, 30), 0.99F) << x;
    EXPECT_LT(found(x, 29), 0.01F) << x;
    EXPECT_LT(found(x, 40), 0.01F) << x;
  }
}

TEST(Silhouettes, TheEdgeOfAPlateauIsNone) {
  // A steep face whose top passes into grazing level ground: a crease in the surface, nothing is
  // hidden.
  Grid<float> depth = plain(40, 60, 10.0);
  for (const auto [x, y] : test::cells({0, 30, 40, 60}))
    depth(x, y) = depth(x, 29) * (1.F - 0.002F * static_cast<float>(y - 29));
  const Grid<float> found = find_silhouettes(depth);
  for (int x = 0; x < 40; ++x) EXPECT_LT(found(x, 30), 0.05F) << x;
}

TEST(Silhouettes, SameBitsForAnyThreadCount) {
  const Grid<float> depth = test::grid_of(
      150, 120, [&](int x, int y) { return 1000.0 + 200.0 * random_uniform(3, x, y); });
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return find_silhouettes(depth);
  };
  EXPECT_EQ(run(1), run(2));
  EXPECT_TRUE(find_silhouettes({}).empty());
}

}  // namespace
}  // namespace belvedere
