#include "renderer/paint/water/water_ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/grid.h"
#include "tests/grids.h"
#include "tests/renderer/trace/synthetic_ground.h"

namespace belvedere {
namespace {

constexpr double bed_cell_m = 10.0;

struct Ground {
  Dem dem;
  Grid<std::uint8_t> water;
};

// A crater of 795 m radius filled to 500 m, whose banks rise by `slope`, and a river of 60 m width
// that leaves it to the east.
Ground crater(double slope) {
  Ground ground;
  ground.dem.altitude_m = Grid<float>(260, 240);
  ground.dem.filled = Grid<std::uint8_t>(260, 240, 0);
  ground.dem.transform = {0.0, 0.0, bed_cell_m, bed_cell_m};
  ground.water = Grid<std::uint8_t>(260, 240, 0);
  for (const auto [x, y] : test::cells(260, 240)) {
    const double r = bed_cell_m * std::hypot(x - 110, y - 120);
    const bool river = x > 110 && std::abs(y - 120) <= 3;
    ground.water(x, y) = r <= 795.0 || river ? 1 : 0;
    ground.dem.altitude_m(x, y) =
        ground.water(x, y) != 0 ? 500.F : static_cast<float>(500.0 + slope * (r - 795.0));
  }
  return ground;
}

TEST(WaterBeds, GoOnAsTheBanksBegin) {
  for (const double slope : {0.1, 0.3}) {
    const Ground g = crater(slope);
    const WaterBeds beds = make_water_beds(g.water, g.dem);
    // Along a row to the west: the shore lies 5 m outside the last cell of water, and the bank at
    // it on average a little outside 800 m.
    for (int x = 31; x < 100; ++x) {
      const double off_m = bed_cell_m * (x - 30) - 5.0;
      const double expected = 60.0 * (1.0 - std::exp(-slope * off_m / 60.0));
      EXPECT_NEAR(beds.depth_m(x, 120), expected, 0.12 * expected + 0.2) << slope << " at " << x;
    }
    for (int x = 31; x < 100; ++x) EXPECT_GE(beds.depth_m(x + 1, 120), beds.depth_m(x, 120));
    EXPECT_EQ(beds.depth_m(20, 120), 0.F);
  }
}

TEST(WaterBeds, SteepBanksFallOffFasterThanFlatOnes) {
  const Ground steep = crater(0.4);
  const Ground flat = crater(0.02);
  EXPECT_GT(make_water_beds(steep.water, steep.dem).depth_m(35, 120),
            3.F * make_water_beds(flat.water, flat.dem).depth_m(35, 120));
}

TEST(WaterBeds, RiversAreNoLakes) {
  const Ground g = crater(0.2);
  const WaterBeds beds = make_water_beds(g.water, g.dem);
  EXPECT_EQ(beds.lake(110, 120), 1.F);
  EXPECT_EQ(beds.lake(32, 120), 1.F) << "up to its shore";
  EXPECT_EQ(beds.lake(110, 45), 1.F);
  EXPECT_EQ(beds.lake(240, 120), 0.F);
  EXPECT_EQ(beds.lake(10, 10), 0.F);
  // It becomes one over a river's width.
  EXPECT_GT(beds.lake(197, 120), 0.F);
  EXPECT_LT(beds.lake(205, 120), 1.F);
}

TEST(WaterBeds, LevelsStayAndWindowsAgree) {
  const Ground g = crater(0.2);
  const Grid<float> before = g.dem.altitude_m;
  const WaterBeds whole = make_water_beds(g.water, g.dem);
  EXPECT_TRUE(g.dem.altitude_m == before);
  // A window whose border is farther away than the reach of beds.
  Ground part;
  part.dem.altitude_m = Grid<float>(120, 200);
  part.dem.filled = Grid<std::uint8_t>(120, 200, 0);
  part.dem.transform = {0.0, 0.0, bed_cell_m, bed_cell_m};
  part.water = Grid<std::uint8_t>(120, 200, 0);
  for (const auto [x, y] : test::cells(120, 200)) {
    part.dem.altitude_m(x, y) = g.dem.altitude_m(x, y + 20);
    part.water(x, y) = g.water(x, y + 20);
  }
  const WaterBeds window = make_water_beds(part.water, part.dem);
  for (const auto [x, y] : test::cells({10, 70, 60, 130})) {
    ASSERT_EQ(window.depth_m(x, y), whole.depth_m(x, y + 20));
    ASSERT_EQ(window.lake(x, y), whole.lake(x, y + 20));
  }
}

TEST(WaterBeds, OceansWithoutAShoreAreDeepAndSizesMustAgree) {
  Ground g = crater(0.2);
  g.water = Grid<std::uint8_t>(260, 240, 1);
  const WaterBeds beds = make_water_beds(g.water, g.dem);
  EXPECT_EQ(beds.depth_m(50, 50), 60.F);
  EXPECT_EQ(beds.lake(50, 50), 1.F);
  EXPECT_THROW(make_water_beds(Grid<std::uint8_t>(3, 3, 0), g.dem), Error);
}

using test::all_meadow;
using test::cell;
using test::make_world;
using test::southward;
using test::SyntheticWorld;

constexpr double level_m = 500.0;
constexpr double shore_m = 5000.0;  // metres south of the first row, where the bank begins
constexpr double above_m = MirrorParameters{}.bias_m;
constexpr double foot_m = shore_m + 0.5 * cell;  // of the bank: posts are the centres of cells
constexpr double steep = 0.7;                    // rise over run of the bank

LandCoverClass lake_or_wood(double, double y) {
  return y <= shore_m ? LandCoverClass::water : LandCoverClass::forest;
}

// A lake in front of a bank that rises evenly to the south, seen from the north.
SyntheticWorld lake_before_bank(DeformParameters deform = {}) {
  return make_world(
      220, 330,
      [](double, double y) { return y <= shore_m ? level_m : level_m + steep * (y - shore_m); },
      lake_or_wood, deform, {653000.0, 5323000.0});
}

MirrorSight mirror(const SyntheticWorld& world, const Camera& camera, PixelRect region,
                   int tile_size = 64) {
  const MirrorParameters p{.sun_direction = glm::normalize(glm::dvec3(0.0, 1.0, 1.0)),
                           .tile_size = tile_size};
  return trace_mirror(world.terrain, world.surface,
                      Deformation(world.deform_parameters, world.viewer), *world.tracer, camera, p,
                      Grid<std::uint8_t>(region.width(), region.height(), 1), region);
}

// The mirrored ray is the ray of an eye as far below the water as the eye is above it.
TEST(WaterMirror, AnEvenBankIsSeenAsFromBelowTheWater) {
  const SyntheticWorld world = lake_before_bank();
  const auto camera = make_camera(southward(64, 160, -18.0));
  const MirrorSight sight = mirror(world, *camera, {0, 0, 64, 160});
  int seen = 0;
  for (int x = 22; x < 44; x += 3) {
    float above = 0.0F;
    for (int y = 0; y < 160; ++y) {
      const Ray ray = camera->ray({x + 0.5, y + 0.5});
      const double to_water = (level_m - ray.origin.z) / ray.direction.z;
      const glm::dvec3 water = ray.origin + ray.direction * to_water;
      const double south = 5320000.0 - water.y;
      if (!(ray.direction.z < 0.0) || south < 60.0 || south > shore_m - 60.0) continue;
      EXPECT_NEAR(sight.cosine(x, y), -ray.direction.z, 1e-5);
      EXPECT_NEAR(sight.rise(x, y), -ray.direction.z, 1e-5);
      EXPECT_NEAR(sight.distance_m(x, y), to_water, 0.5);
      // Where above - d.z t = steep (south - foot - d.y t), upwards along the mirrored direction.
      const double rises = -ray.direction.z;
      const double runs = -ray.direction.y;
      if (steep * runs < rises) {
        EXPECT_EQ(sight.land_cover(x, y), LandCoverClass::sky) << "the ray rises over the bank";
        continue;
      }
      const double path = (steep * (foot_m - south) + above_m) / (steep * runs - rises);
      const double altitude = level_m + above_m + rises * path;
      if (std::abs(water.x + ray.direction.x * path - 653300.0) > 3200.0) continue;
      // Beyond the ground, and at the foot, which shares cells with the water.
      if (south + runs * path > 9000.0 || south + runs * path < shore_m + 60.0) continue;
      ++seen;
      ASSERT_EQ(sight.land_cover(x, y), LandCoverClass::forest) << y;
      EXPECT_NEAR(sight.path_m(x, y), path, 0.01 * path + 3.0);
      EXPECT_NEAR(sight.altitude_m(x, y), altitude, 3.0);
      EXPECT_EQ(sight.shadow(x, y), 1.0F);
      // Upside down: higher ground is farther down in the picture.
      EXPECT_GT(sight.altitude_m(x, y), above);
      above = sight.altitude_m(x, y);
      // Normals for lighting: of the bank where the smoothing over 120 m does not reach its foot.
      if (altitude > level_m + 300.0) {
        EXPECT_NEAR(sight.normal(x, y).y, steep / std::sqrt(1.0 + steep * steep), 0.01);
      }
    }
  }
  EXPECT_GT(seen, 40);
}

TEST(WaterMirror, ShowsTheSkyWhereNothingStands) {
  const SyntheticWorld world = make_world(
      200, 200, [](double, double) { return level_m; },
      [](double, double) { return LandCoverClass::water; });
  const auto camera = make_camera(southward(48, 48));
  const MirrorSight sight = mirror(world, *camera, {0, 0, 48, 48});
  int waters = 0;
  for (std::size_t i = 0; i < sight.cosine.size(); ++i) {
    EXPECT_EQ(sight.land_cover[i], LandCoverClass::sky);
    EXPECT_TRUE(std::isinf(sight.path_m[i]));
    waters += sight.cosine[i] > 0.0F ? 1 : 0;
  }
  EXPECT_GT(waters, 300);
}

TEST(WaterMirror, WaterIsTiltedAsTheGroundIsBent) {
  DeformParameters d;
  d.exaggeration = 1.6;
  d.bend = {60000.0, 9000.0, 8000.0, 1e-5};
  const glm::dvec2 viewer(653000.0, 5323000.0);
  const Deformation deformation(d, viewer);
  for (const double away : {2000.0, 6000.0, 20000.0}) {
    const glm::dvec3 normal = water_normal(deformation, {viewer.x, viewer.y - away, 700.0});
    const double slope = (deformation.drop_m(away + 1.0) - deformation.drop_m(away - 1.0)) /
                         2.0;  // sinks away from the viewer
    EXPECT_NEAR(normal.x, 0.0, 1e-9);
    EXPECT_NEAR(normal.y / normal.z, -slope, 1e-5) << away;
  }
  // Without bending it is vertical, whatever the exaggeration.
  DeformParameters flat;
  flat.exaggeration = 1.6;
  EXPECT_NEAR(water_normal(Deformation(flat, viewer), {viewer.x + 5000.0, viewer.y, 700.0}).z, 1.0,
              1e-12);
}

TEST(WaterMirror, AnyRegionAndAnyTilesGiveTheSameBits) {
  DeformParameters d;
  d.exaggeration = 1.4;
  d.bend = {60000.0, 9000.0, 8000.0, 1e-5};
  const SyntheticWorld world = lake_before_bank(d);
  const auto camera = make_camera(southward(96, 120));
  const MirrorSight whole = mirror(world, *camera, {0, 0, 96, 120});
  for (const PixelRect rect :
       {PixelRect{5, 30, 23, 71}, PixelRect{60, 47, 61, 48}, PixelRect{0, 0, 96, 120}}) {
    const MirrorSight part = mirror(world, *camera, rect, 8);
    EXPECT_TRUE(part.cosine == part_of(whole.cosine, rect));
    EXPECT_TRUE(part.path_m == part_of(whole.path_m, rect));
    EXPECT_TRUE(part.rise == part_of(whole.rise, rect));
    EXPECT_TRUE(part.land_cover == part_of(whole.land_cover, rect));
    EXPECT_TRUE(part.altitude_m == part_of(whole.altitude_m, rect));
    EXPECT_TRUE(part.normal == part_of(whole.normal, rect));
    EXPECT_TRUE(part.shadow == part_of(whole.shadow, rect));
  }
}

TEST(WaterMirror, NothingIsTracedWhereNothingIsWanted) {
  const SyntheticWorld world = lake_before_bank();
  const auto camera = make_camera(southward(64, 64));
  const MirrorSight none =
      trace_mirror(world.terrain, world.surface, Deformation(world.deform_parameters, world.viewer),
                   *world.tracer, *camera, {}, Grid<std::uint8_t>(64, 64, 0), {0, 0, 64, 64});
  for (const float cosine : none.cosine) ASSERT_EQ(cosine, 0.0F);
  EXPECT_THROW(trace_mirror(world.terrain, world.surface, Deformation(), *world.tracer, *camera, {},
                            Grid<std::uint8_t>(3, 3, 0), {0, 0, 64, 64}),
               Error);
}

TEST(WaterGround, KnowsLakesByTheirPlace) {
  const SyntheticWorld world = lake_before_bank();
  const auto ground = find_water_ground(world.terrain);
  ASSERT_NE(ground, nullptr);
  const WaterGround::Place off = ground->at({653000.0, 5320000.0 - shore_m + 300.0});
  EXPECT_EQ(off.lake, 1.0F);
  // The bank's slope of .7 is above the limit for beds.
  EXPECT_NEAR(off.depth_m, 60.0 * (1.0 - std::exp(-0.6 * 300.0 / 60.0)), 1.0);
  EXPECT_EQ(ground->at({653000.0, 5320000.0 - shore_m - 300.0}).depth_m, 0.0F);
  const SyntheticWorld dry = make_world(
      30, 30, [](double, double) { return level_m; }, all_meadow);
  EXPECT_EQ(find_water_ground(dry.terrain), nullptr);
}

}  // namespace
}  // namespace belvedere
