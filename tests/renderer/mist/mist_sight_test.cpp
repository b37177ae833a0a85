#include "renderer/mist/mist_sight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/grid.h"
#include "base/parallel.h"
#include "tests/grids.h"
#include "tests/renderer/trace/synthetic_ground.h"

namespace belvedere {
namespace {

using test::all_meadow;
using test::make_world;
using test::SyntheticWorld;

// A sea of fog without heaps or soft edges.
MistAir flat_sea(double to_m, double visibility_m, const SyntheticWorld& world) {
  MistAir air;
  air.layers = {
      {.to_m = to_m, .visibility_m = visibility_m, .edge_m = 0.0, .billows = 0.0, .position = {}}};
  air.ground = make_mist_ground(world.terrain.generalized_m, world.terrain.rim_m,
                                world.terrain.dem->transform, false);
  air.farthest_m = 60000.0;
  return air;
}

MistSight see(const MistAir& air, const SyntheticWorld& world, const Camera& camera,
              const GuidanceBuffers& guidance) {
  const Deformation deformation(world.deform_parameters, world.viewer);
  return see_mist(air, {.camera = camera, .deformation = deformation}, guidance.depth_m, {0, 0});
}

// Parallel rays that fall by 30° cross a layer 300 m high over 600 m: exp(-ln 50 · 600 /
// visibility) remains.
TEST(MistSight, OverAPlaneALayerLetsThroughWhatTheFormulaSays) {
  const SyntheticWorld world = make_world(
      200, 200, [](double, double) { return 500.0; }, all_meadow);
  const CameraParameters p{.projection = "oblique",
                           .width = 60,
                           .height = 40,
                           .eye = {653000.0, 5318000.0, 3000.0},
                           .azimuth_deg = 180.0,
                           .pitch_deg = -30.0,
                           .view_width_m = 2400.0};
  const auto camera = make_camera(p);
  const GuidanceBuffers guidance = test::trace(world, *camera);
  const MistSight sight = see(flat_sea(800.0, 2000.0, world), world, *camera, guidance);
  const double left = std::exp(-std::log(50.0) * 600.0 / 2000.0);
  int seen = 0;
  for (std::size_t i = 0; i < sight.share.size(); ++i) {
    if (guidance.is_sky(i)) continue;
    ++seen;
    EXPECT_NEAR(sight.share[i], 1.0 - left, 2e-3);
    EXPECT_GT(sight.depth_m[i], guidance.depth_m[i] - 601.0);
    EXPECT_LT(sight.depth_m[i], guidance.depth_m[i]);
  }
  EXPECT_GT(seen, 500);
}

// Through the centres of pixels, as for mist.
GuidanceBuffers trace_centres(const SyntheticWorld& world, const Camera& camera) {
  GuidanceParameters parameters;
  parameters.sampling.pixel_samples = 1;
  return test::trace(world, camera, parameters);
}

double cone_m(double east, double south) {
  return std::max(0.0, 2000.0 - 0.5 * std::sqrt((east - 3000.0) * (east - 3000.0) +
                                                (south - 3900.0) * (south - 3900.0)));
}

// Dense fog up to 1000 m over a cone: an island whose shore is the contour of 1000 m, however the
// ground is bent.
void expect_island(const DeformParameters& deformed) {
  const SyntheticWorld world = make_world(200, 260, cone_m, all_meadow, deformed);
  CameraParameters p = test::southward(160, 120, -38.0);
  p.eye.z = 9000.0;
  const auto camera = make_camera(p);
  const GuidanceBuffers guidance = trace_centres(world, *camera);
  const MistSight sight = see(flat_sea(1000.0, 2.0, world), world, *camera, guidance);
  int island = 0, sea = 0;
  for (std::size_t i = 0; i < sight.share.size(); ++i) {
    if (guidance.is_sky(i)) continue;
    const float altitude = guidance.altitude_m[i];
    if (altitude > 1002.0F) {
      ++island;
      EXPECT_EQ(sight.share[i], 0.F) << altitude;
    } else if (altitude < 994.0F) {
      ++sea;
      EXPECT_GT(sight.share[i], 0.98F) << altitude;
    }
  }
  EXPECT_GT(island, 300);
  EXPECT_GT(sea, 1000);
}

TEST(MistSight, AConeStandsOutAsAnIslandWithItsShoreAtTheAltitude) { expect_island({}); }

TEST(MistSight, OnBentAndRaisedGroundTheShoreStaysAtItsAltitude) {
  DeformParameters d;
  d.exaggeration = 1.6;
  d.bend = {60000.0, 9000.0, 8000.0, 1e-5};
  expect_island(d);
  d.summits = {{{653000.0, 5316100.0}, 2500.0, 1.5, 400.0}};
  expect_island(d);
}

// Ground in front of the sea is not in it, and the sky is veiled only where the line of sight
// passes through it.
TEST(MistSight, NearerGroundStandsBeforeTheSea) {
  const SyntheticWorld world = make_world(200, 260, cone_m, all_meadow);
  const auto camera = make_camera(test::southward(40, 30));
  Grid<float> near(40, 30, 500.F);
  const Deformation deformation(world.deform_parameters, world.viewer);
  const MistSight sight = see_mist(flat_sea(1000.0, 2.0, world),
                                   {.camera = *camera, .deformation = deformation}, near, {0, 0});
  EXPECT_TRUE(std::all_of(sight.share.begin(), sight.share.end(),
                          [](float share) { return share == 0.F; }));
  EXPECT_TRUE(std::all_of(sight.depth_m.begin(), sight.depth_m.end(),
                          [](float depth) { return std::isinf(depth); }));
}

// Heaps, banks, a lee cloud and cast shadows, in any rectangle and with any threads.
TEST(MistSight, AnyRectangleAndAnyThreadsGiveTheBitsOfTheWhole) {
  const SyntheticWorld world = test::rough_world();
  const auto camera = make_camera(test::southward(150, 110));
  const GuidanceBuffers guidance = test::trace(world, *camera);
  const Deformation deformation(world.deform_parameters, world.viewer);
  MistAir air = flat_sea(1100.0, 300.0, world);
  air.layers.front().billows = 1.0;
  air.layers.push_back(
      {.kind = MistKind::valley, .height_m = 200.0, .patches = 0.4, .position = {}});
  air.ground = make_mist_ground(world.terrain.generalized_m, world.terrain.rim_m,
                                world.terrain.dem->transform, true);
  air.rim_fade_m = 1000.0;
  const auto cloud = make_lee_cloud(
      {.kind = MistKind::lee, .position = glm::dvec2(653000.0, 5317500.0), .size_m = 2000.0},
      1500.0, deformation, *camera, 3);
  ASSERT_TRUE(cloud.has_value());
  air.clouds = {*cloud};
  const MistView view{.camera = *camera,
                      .deformation = deformation,
                      .tracer = world.tracer.get(),
                      .sun_direction = {-0.6, 0.6, 0.53}};
  const MistSight whole = see_mist(air, view, guidance.depth_m, {0, 0});
  const auto misty = std::count_if(whole.share.begin(), whole.share.end(),
                                   [](float share) { return share > 0.5F; });
  EXPECT_GT(misty, 2000);
  const ThreadLimit one(1);
  for (const PixelRect rect : {PixelRect{17, 60, 90, 109}, {100, 31, 101, 32}, {0, 0, 150, 110}}) {
    const MistSight part = see_mist(air, view, part_of(guidance.depth_m, rect), {rect.x0, rect.y0});
    EXPECT_TRUE(part.share == part_of(whole.share, rect));
    EXPECT_TRUE(part.depth_m == part_of(whole.depth_m, rect));
    EXPECT_TRUE(part.light == part_of(whole.light, rect));
    EXPECT_TRUE(part.altitude_m == part_of(whole.altitude_m, rect));
  }
}

// A wall of rock between the sun and the sea casts its shadow on it.
TEST(MistSight, SummitsThrowShadowsOnTheSea) {
  const SyntheticWorld world = make_world(200, 260, cone_m, all_meadow);
  CameraParameters p = test::southward(160, 120, -38.0);
  p.eye.z = 9000.0;
  const auto camera = make_camera(p);
  const GuidanceBuffers guidance = test::trace(world, *camera);
  const Deformation deformation(world.deform_parameters, world.viewer);
  const MistAir air = flat_sea(1000.0, 50.0, world);
  MistView view{.camera = *camera,
                .deformation = deformation,
                .tracer = world.tracer.get(),
                .sun_direction = {0.94, 0.0, 0.34}};
  const MistSight shaded = see_mist(air, view, guidance.depth_m, {0, 0});
  view.tracer = nullptr;
  const MistSight open = see_mist(air, view, guidance.depth_m, {0, 0});
  // The sun is in the east, on the left of a view to the south: the shadow falls to the right.
  int left = 0, right = 0;
  for (const auto [x, y] : test::cells(160, 120))
    if (shaded.share(x, y) > 0.9F && shaded.light(x, y) < 0.8F * open.light(x, y))
      ++(x < 80 ? left : right);
  EXPECT_GT(right, 40);
  EXPECT_GT(right, 4 * left);
}

TEST(MistSight, WithoutMistNothingIsSeen) {
  const SyntheticWorld world = make_world(
      20, 20, [](double, double) { return 500.0; }, all_meadow);
  const auto camera = make_camera(test::southward(16, 16));
  const Deformation deformation;
  const MistSight sight = see_mist({}, {.camera = *camera, .deformation = deformation},
                                   Grid<float>(16, 16, 100.F), {0, 0});
  EXPECT_EQ(sight.share, Grid<float>(16, 16, 0.F));
}

constexpr double metres_per_unit = 20.0;

TEST(MistBillows, WithoutStrengthTheSurfaceIsFlat) {
  MistBillows flat(1, 0.0, 90.0);
  EXPECT_TRUE(flat.flat());
  EXPECT_EQ(flat.height_m({1234.0, 77.0}, metres_per_unit), 0.0);
}

TEST(MistBillows, HeapsStayWithinTheirReachAndAboutTheSurface) {
  for (const double metres : {3.0, 20.0, 70.0}) {
    MistBillows billows(3, 1.0, 90.0);
    double low = 1e9, high = -1e9, sum = 0.0;
    int count = 0;
    for (int y = 0; y < 120; ++y)
      for (int x = 0; x < 120; ++x, ++count) {
        const double height = billows.height_m({x * 11.0 * metres, y * 11.0 * metres}, metres);
        low = std::min(low, height), high = std::max(high, height), sum += height;
      }
    EXPECT_LE(high, billows.reach_m());
    EXPECT_GE(low, -billows.reach_m());
    EXPECT_GT(high - low, 0.5 * std::min(90.0, 0.085 * MistBillows::length_m(metres)));
    EXPECT_LT(std::abs(sum / count), 0.12 * (high - low)) << metres;
  }
}

TEST(MistBillows, TwiceTheStrengthIsTwiceTheHeight) {
  MistBillows one(5, 1.0, 90.0);
  MistBillows two(5, 2.0, 90.0);
  for (const double x : {10.0, 400.0, 9000.0})
    EXPECT_NEAR(two.height_m({x, 50.0}, metres_per_unit),
                2.0 * one.height_m({x, 50.0}, metres_per_unit), 1e-9);
}

// Octaves fade in and out with distance, without a jump.
TEST(MistBillows, DistanceChangesThemSmoothly) {
  MistBillows billows(7, 1.0, 90.0);
  double before = billows.height_m({5000.0, 7000.0}, 5.0);
  double largest = 0.0;
  for (double metres = 5.0; metres < 80.0; metres *= 1.005) {
    const double height = billows.height_m({5000.0, 7000.0}, metres);
    largest = std::max(largest, std::abs(height - before));
    before = height;
  }
  EXPECT_LT(largest, 3.0);
}

// A pure function of the position, whatever was evaluated before.
TEST(MistBillows, AnswersHangOnThePlaceAlone) {
  MistBillows one(9, 1.0, 90.0);
  MistBillows other(9, 1.0, 90.0);
  for (int k = 0; k < 50; ++k) one.height_m({k * 991.0, k * 317.0}, 5.0 + k);
  EXPECT_EQ(one.height_m({650123.0, 5230456.0}, 17.0), other.height_m({650123.0, 5230456.0}, 17.0));
}

TEST(MistProfile, OverTheSightAFiftiethIsLeft) {
  const MistProfile mist = make_mist_profile(800.0, 0.0);
  EXPECT_NEAR(std::exp(-optical_depth(mist, 800.0, 100.0, 100.0)), 0.02, 1e-12);
}

TEST(MistProfile, NothingLiesAboveTheSurface) {
  const MistProfile mist = make_mist_profile(300.0, 80.0);
  EXPECT_EQ(extinction_at(mist, 0.0), 0.0);
  EXPECT_EQ(extinction_at(mist, -5.0), 0.0);
  EXPECT_EQ(optical_depth(mist, 1000.0, -400.0, -1.0), 0.0);
  EXPECT_EQ(optical_depth(mist, 1000.0, -1.0, -1.0), 0.0);
}

// Straight down through the edge and beyond: full · (depth - edge / 2).
TEST(MistProfile, StraightDownItIsTheIntegralOfARamp) {
  const MistProfile mist{0.01, 80.0};
  EXPECT_NEAR(optical_depth(mist, 40.0, 0.0, 40.0), 0.01 * 40.0 * 40.0 / 160.0, 1e-12);
  EXPECT_NEAR(optical_depth(mist, 300.0, 0.0, 300.0), 0.01 * (300.0 - 40.0), 1e-12);
  EXPECT_NEAR(optical_depth(mist, 500.0, -200.0, 300.0), 0.01 * (300.0 - 40.0), 1e-12);
}

// However a path is divided, the sum is the same, and equal to that of many small steps by the
// midpoint rule.
TEST(MistProfile, AWayIsTheSumOfItsParts) {
  const MistProfile mist{0.012, 60.0};
  const double length = 700.0;
  const double from = -90.0;
  const double to = 210.0;
  const auto below = [&](double t) { return from + (to - from) * t / length; };
  double parts = 0.0;
  double fine = 0.0;
  for (int k = 0; k < 7; ++k)
    parts += optical_depth(mist, 100.0, below(100.0 * k), below(100.0 * (k + 1)));
  for (int k = 0; k < 70000; ++k) fine += 0.01 * extinction_at(mist, below(0.01 * (k + 0.5)));
  EXPECT_NEAR(parts, optical_depth(mist, length, from, to), 1e-12);
  EXPECT_NEAR(fine, optical_depth(mist, length, from, to), 1e-6);
  EXPECT_NEAR(optical_depth(mist, length, to, from), optical_depth(mist, length, from, to), 1e-12);
}

TEST(MistProfile, LevelWaysAgreeWithNearlyLevelOnes) {
  const MistProfile mist{0.012, 60.0};
  EXPECT_NEAR(optical_depth(mist, 900.0, 30.0, 30.0), optical_depth(mist, 900.0, 29.99, 30.01),
              1e-9);
}

}  // namespace
}  // namespace belvedere
