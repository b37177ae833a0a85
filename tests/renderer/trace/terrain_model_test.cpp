#include "renderer/trace/terrain_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <utility>

#include "base/error.h"
#include "base/guidance_buffers.h"
#include "renderer/paint/terrain_end.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/guidance_ground.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr double cell_m = 30.0;

template <class Altitude>
TerrainModel model_of(int width, int height, Altitude&& altitude) {
  Raster<float> raster;
  raster.transform = {650000.0, 5320000.0, cell_m, cell_m};
  raster.cells = Grid<float>(width, height);
  for (const auto [x, y] : test::cells(width, height))
    raster.cells(x, y) = static_cast<float>(altitude(x, y));
  LandCover land_cover;
  land_cover.classes.transform = raster.transform;
  land_cover.classes.cells = Grid<LandCoverClass>(width, height, LandCoverClass::alpine_grass);
  Dem dem = make_dem(std::move(raster));
  Grid<float> generalized = dem.altitude_m;
  return make_terrain_model(std::make_shared<const Dem>(std::move(dem)), std::move(generalized),
                            std::make_shared<const LandCover>(std::move(land_cover)), 1.0);
}

TEST(TerrainModel, LandCoverWithoutCellsIsRefused) {
  Raster<float> raster;
  raster.transform = {650000.0, 5320000.0, cell_m, cell_m};
  raster.cells = Grid<float>(4, 4, 500.F);
  const auto dem = std::make_shared<const Dem>(make_dem(std::move(raster)));
  EXPECT_THROW(make_terrain_model(dem, dem->altitude_m, std::make_shared<const LandCover>(), 1.0),
               Error);
}

TEST(TerrainModel, FlowOnATiltedPlaneIsTheLogarithmOfTheStripAbove) {
  // Falls to the south: each column of cells drains by itself, and row y has y + 1 cells above it
  // and in it.
  const TerrainModel model = model_of(9, 60, [](int, int y) { return 500.0 - 3.0 * y; });
  for (const auto [x, y] : test::cells(9, 60))
    EXPECT_NEAR(model.flow(x, y), std::log10(cell_m * cell_m * (y + 1)), 1e-5) << x << ' ' << y;
}

TEST(TerrainModel, FlowGathersInAValley) {
  // Flanks 1 in 2 and a floor that falls to the south, where all of 61 × 80 cells drain except for
  // what leaves at the sides.
  const TerrainModel model =
      model_of(61, 80, [](int x, int y) { return 900.0 - y + 15.0 * std::abs(x - 30); });
  EXPECT_NEAR(model.flow(30, 79), std::log10(61.0 * 80.0 * cell_m * cell_m), 0.01);
  EXPECT_LT(model.flow(5, 40), std::log10(6.0 * cell_m * cell_m));
}

TEST(TerrainModel, FlowIsReadWhereTheGroundCameFrom) {
  TerrainModel model = model_of(40, 60, [](int, int y) { return 500.0 - 3.0 * y; });
  const glm::dvec2 viewer{650600.0, 5319000.0};
  const DeformedSurface surface =
      deform(model.generalized_m, model.dem->transform, viewer, {viewer, 0.0}, DeformParameters{});
  CameraParameters p;
  p.width = p.height = 16;
  p.eye = {650600.0, 5323000.0, 3500.0};
  p.azimuth_deg = 180.0;
  const auto camera = make_camera(p);
  const auto flow_at = [&](double column, double row) {
    GuidanceBuffers out;
    for (const GuidanceChannel& channel : guidance_channels())
      fill_channel(out, channel, 1, 1, channel.sky);
    sample_ground(model, surface, *camera, column, row, out, 0);
    return out.flow[0];
  };
  EXPECT_NEAR(flow_at(20.0, 29.0), std::log10(30.0 * cell_m * cell_m), 1e-5);
  EXPECT_NEAR(flow_at(20.3, 29.5), 0.5 * std::log10(30.0 * 31.0) + std::log10(cell_m * cell_m),
              1e-5)
      << "the mean of the logarithms";
  model.came_from = Grid<glm::vec2>(
      40, 60, glm::vec2(0.F, -10.F));  // all of it ten cells farther south than it was
  EXPECT_NEAR(flow_at(20.0, 29.0), std::log10(20.0 * cell_m * cell_m), 1e-5);
}

constexpr double ring_cell_m = 30.0;

template <class Altitude>
Dem dem_of(int width, int height, Altitude&& altitude) {
  Raster<float> raster;
  raster.transform = {650000.0, 5320000.0, ring_cell_m, ring_cell_m};
  raster.cells = Grid<float>(width, height);
  for (const auto [x, y] : test::cells(width, height))
    raster.cells(x, y) = static_cast<float>(altitude(x, y));
  return make_dem(std::move(raster));
}

LandCover cover_of(const Dem& dem, LandCoverClass id) {
  LandCover cover;
  cover.classes.transform = dem.transform;
  cover.classes.cells = Grid<LandCoverClass>(dem.width(), dem.height(), id);
  return cover;
}

TEST(GroundSurroundings, HeightAboveAValleyIsThatAboveItsFloor) {
  // A trough: 300 m deep, its floor five cells wide, flanks of 10 m per cell.
  const Dem dem = dem_of(81, 60, [](int x, int) {
    return 500.0 + std::clamp(10.0 * (std::abs(x - 40) - 2), 0.0, 300.0);
  });
  const GroundSurroundings found = find_surroundings(dem, cover_of(dem, LandCoverClass::pasture));
  EXPECT_NEAR(found.valley_height_m(40, 30), 0.0, 0.5);
  EXPECT_NEAR(found.valley_height_m(50, 30), 80.0, 0.5);
  EXPECT_NEAR(found.valley_height_m(31, 30), 70.0, 0.5);
}

TEST(GroundSurroundings, TheRimIsTheBorderAndVoidsThatReachIt) {
  Dem dem = dem_of(40, 30, [](int x, int y) { return 500.0 + x + 2.0 * y; });
  const LandCover cover = cover_of(dem, LandCoverClass::pasture);
  const GroundSurroundings whole = find_surroundings(dem, cover);
  for (const auto [x, y] : test::cells(40, 30))
    EXPECT_NEAR(whole.rim_m(x, y), ring_cell_m * std::min(std::min(x, 39 - x), std::min(y, 29 - y)),
                1e-3)
        << x << ' ' << y;
  dem.filled = Grid<std::uint8_t>(40, 30, 0);
  dem.filled(20, 15) = 1;                              // a void inside known terrain
  for (int x = 0; x <= 9; ++x) dem.filled(x, 14) = 1;  // a void that reaches the border
  const GroundSurroundings voids = find_surroundings(dem, cover);
  EXPECT_NEAR(voids.rim_m(20, 15), ring_cell_m * std::hypot(11.0, 1.0), 1e-3);
  EXPECT_EQ(voids.rim_m(9, 14), 0.F);
  EXPECT_NEAR(voids.rim_m(12, 18), ring_cell_m * 5.0, 1e-3);
}

TEST(GroundSurroundings, CatchmentsThatAreThereAreTaken) {
  const Dem dem = dem_of(9, 60, [](int, int y) { return 500.0 - 3.0 * y; });
  const LandCover cover = cover_of(dem, LandCoverClass::settlement);
  Catchments catchments(dem);
  catchments.km2();
  const GroundSurroundings found = find_surroundings(dem, cover, &catchments);
  EXPECT_EQ(found.flow, find_surroundings(dem, cover).flow);
  for (int y = 0; y < 60; ++y)
    EXPECT_NEAR(found.flow(4, y), std::log10(ring_cell_m * ring_cell_m * (y + 1)), 1e-5) << y;
  // Everything is town.
  for (const float built : found.floor_plan.built) EXPECT_NEAR(built, 1.F, 1e-4F);
}

constexpr double rim_cell_m = 90.0;
constexpr int rim_posts = 300;
constexpr double rim_side_m = rim_posts * rim_cell_m;
constexpr double fade_of_side = 0.03;

// Hills of a few hundred metres and, by the northern edge, one mountain of `height_m`, `summit`
// rows from it.
Dem hills_with_mountain(double height_m, int summit) {
  Raster<float> raster;
  raster.transform = {460000.0, 3110000.0, rim_cell_m, rim_cell_m};
  raster.cells = Grid<float>(rim_posts, rim_posts);
  for (const auto [x, y] : test::cells(rim_posts, rim_posts)) {
    const double hills = 200.0 * std::sin(0.11 * x + 0.05 * y);
    const double off_m = rim_cell_m * std::hypot(x - 150, y - summit);
    raster.cells(x, y) = static_cast<float>(4500.0 + hills + height_m * std::exp(-off_m / 1500.0));
  }
  return make_dem(std::move(raster));
}

// Share of a position's colour that the end of the terrain leaves.
float kept_of(float rim_m, double fade_m) {
  const TerrainEnd end = terrain_end_at(rim_m, fade_m);
  return (1.0F - end.air) * (1.0F - end.dissolved);
}

TEST(TerrainRim, IsTheDistanceToTheEdgeWhereNothingStandsOut) {
  const Grid<float> rim = rim_distance(hills_with_mountain(0.0, 10));
  for (const auto [x, y] : test::cells(rim_posts, rim_posts)) {
    const int last = rim_posts - 1;
    ASSERT_NEAR(rim(x, y), rim_cell_m * std::min(std::min(x, last - x), std::min(y, last - y)),
                0.01)
        << x << ' ' << y;
  }
}

TEST(TerrainRim, ATallMountainAtTheEdgeKeepsItsColour) {
  const double fade_m = fade_of_side * rim_side_m;
  for (const int summit : {2, 6, 12, 40}) {
    const Grid<float> rim = rim_distance(hills_with_mountain(3000.0, summit));
    EXPECT_GE(kept_of(rim(150, summit), fade_m), 0.75F) << summit << " rows from the edge";
    EXPECT_LT(kept_of(rim(20, 1), fade_m), 0.2F) << "far from it ground still fades";
  }
}

// Lines of sight to the north, straight and aslant: what lies farther is never clearer.
TEST(TerrainRim, NoGroundFadesMoreThanGroundBehindIt) {
  const double fade_m = fade_of_side * rim_side_m;
  for (const int summit : {2, 12, 40, 67}) {
    const Grid<float> rim = rim_distance(hills_with_mountain(3000.0, summit));
    for (const double aslant : {-2.5, -0.9, -0.4, 0.0, 0.4, 0.9, 2.5})
      for (int from = 100; from < 200; from += 3) {
        float nearer = 1.0F;
        for (int step = 0; step < 100; ++step) {
          const int x = from + static_cast<int>(std::lround(aslant * step));
          const int y = 100 - step;
          if (!rim.contains(x, y)) break;
          const float kept = kept_of(rim(x, y), fade_m);
          ASSERT_LE(kept, nearer + 0.03F) << x << ' ' << y << ", summit in row " << summit;
          nearer = std::min(nearer, kept);
        }
      }
  }
}

using enum LandCoverClass;

struct Map {
  Dem dem;
  LandCover cover;
};

// 30 m cells; altitude and class by metres east and north of the centre.
Map make_map(int size, const std::function<double(double, double)>& altitude,
             const std::function<LandCoverClass(double, double)>& id) {
  Map map;
  map.dem.altitude_m = Grid<float>(size, size);
  map.dem.filled = Grid<std::uint8_t>(size, size, 0);
  map.dem.transform = {1000.0, 5000.0, 30.0, 30.0};
  map.cover.classes.cells = Grid<LandCoverClass>(size, size);
  map.cover.classes.transform = map.dem.transform;
  for (const auto [x, y] : test::cells(size, size)) {
    const double e = 30.0 * (x - size / 2);
    const double n = -30.0 * (y - size / 2);
    map.dem.altitude_m(x, y) = static_cast<float>(altitude(e, n));
    map.cover.classes.cells(x, y) = id(e, n);
  }
  return map;
}

double level_ground(double, double) { return 600.0; }

TEST(FloorPlan, GrainFollowsARiver) {
  for (const double degrees : {0.0, 30.0, 90.0, 135.0}) {
    const double a = degrees * 3.14159265 / 180.0;
    const Map map = make_map(120, level_ground, [&](double e, double n) {
      return std::abs(n * std::cos(a) - e * std::sin(a)) < 60.0 ? water : valley_floor;
    });
    const FloorPlan plan = plan_floor(map.cover, map.dem);
    for (const glm::ivec2 position : {glm::ivec2(60, 60), glm::ivec2(66, 52)}) {
      const glm::vec2 grain = plan.grain(position.x, position.y);
      EXPECT_GT(glm::length(grain), 0.5F) << degrees;
      EXPECT_GT(glm::dot(glm::normalize(grain), glm::vec2(std::cos(2.0 * a), std::sin(2.0 * a))),
                0.97F)
          << degrees;
    }
  }
}

TEST(FloorPlan, GrainFollowsTheFootOfTheSlopeWhereNoRiverIs) {
  // A valley that runs from southwest to northeast.
  const auto trough = [](double e, double n) {
    return 600.0 + 0.5 * std::max(0.0, std::abs(n - e) / 1.41421 - 500.0);
  };
  const Map map = make_map(120, trough, [](double, double) { return valley_floor; });
  const glm::vec2 grain = plan_floor(map.cover, map.dem).grain(60, 60);
  EXPECT_NEAR(grain.x, 0.F, 0.1F);
  EXPECT_GT(grain.y, 0.4F);  // twice 45°
}

TEST(FloorPlan, OpenPlainHasNoGrainAndNoHouses) {
  const Map map = make_map(60, level_ground, [](double, double) { return valley_floor; });
  const FloorPlan plan = plan_floor(map.cover, map.dem);
  for (std::size_t i = 0; i < plan.built.size(); ++i) {
    EXPECT_EQ(plan.built[i], 0.F);
    EXPECT_EQ(plan.grain[i], glm::vec2(0.F));
  }
}

TEST(FloorPlan, TownsAreDenserThanVillagesAndInTheirMiddle) {
  const auto built_in_middle = [](double radius_m, double at_m) {
    const Map map = make_map(160, level_ground, [&](double e, double n) {
      return std::hypot(e, n) < radius_m ? settlement : valley_floor;
    });
    return plan_floor(map.cover, map.dem).built(80 + static_cast<int>(at_m / 30.0), 80);
  };
  EXPECT_LT(built_in_middle(180.0, 0.0), 0.4F);
  EXPECT_GT(built_in_middle(180.0, 0.0), 0.2F);
  EXPECT_GT(built_in_middle(1000.0, 0.0), 0.85F);
  EXPECT_LT(built_in_middle(1000.0, 900.0), 0.55F);
}

}  // namespace
}  // namespace belvedere
