#include "renderer/trace/guidance_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "renderer/trace/guidance.h"
#include "terrain/cover/map_cover.h"
#include "tests/grids.h"
#include "tests/renderer/trace/synthetic_ground.h"

namespace belvedere {
namespace {

using test::cell;
using test::make_world;
using test::southward;
using test::SyntheticWorld;
using test::trace;

// Bumps of surface layers appear in the normals of level ground, symmetric about up, smaller from
// afar, and none on water; nothing else changes.
TEST(GuidanceGround, BumpsOfLayersTurnTheNormals) {
  const auto made = [](double height_m, double length_m) {
    SyntheticWorld world = make_world(
        200, 200, [](double, double) { return 500.0; },
        [](double x, double) {
          return x > 3000.0 ? LandCoverClass::alpine_grass : LandCoverClass::water;
        });
    LandCover cover = *world.terrain.land_cover;
    cover.relief.transform = cover.classes.transform;
    cover.relief.bumps.push_back({height_m, length_m, 7, Grid<float>(200, 200, 1.F)});
    world.terrain.land_cover = std::make_shared<const LandCover>(std::move(cover));
    return world;
  };
  const auto camera = make_camera(southward(96, 64));
  const GuidanceBuffers smooth = trace(made(0.0, 300.0), *camera);
  const GuidanceBuffers bumpy = trace(made(12.0, 300.0), *camera);
  glm::dvec3 sum(0.0);
  double near = 0.0;
  double far = 0.0;
  int near_count = 0;
  int far_count = 0;
  for (std::size_t i = 0; i < bumpy.depth_m.size(); ++i) {
    if (bumpy.is_sky(i)) continue;
    ASSERT_EQ(bumpy.depth_m[i], smooth.depth_m[i]);
    ASSERT_EQ(bumpy.shadow[i], smooth.shadow[i]);
    ASSERT_EQ(bumpy.slope_deg[i], smooth.slope_deg[i]);
    if (bumpy.land_cover[i] == LandCoverClass::water) {
      ASSERT_EQ(bumpy.normal[i], glm::vec3(0.F, 0.F, 1.F));
      continue;
    }
    EXPECT_NEAR(glm::length(bumpy.normal[i]), 1.0, 1e-5);
    sum += glm::dvec3(bumpy.normal[i]);
    const double tilt = 1.0 - static_cast<double>(bumpy.normal[i].z);
    const bool is_near = bumpy.footprint_m[i] < 60.F;
    (is_near ? near : far) += tilt;
    ++(is_near ? near_count : far_count);
  }
  ASSERT_GT(near_count, 200);
  ASSERT_GT(far_count, 200);
  const glm::dvec3 mean = sum / static_cast<double>(near_count + far_count);
  EXPECT_LT(glm::length(glm::dvec2(mean)), 0.02);
  EXPECT_GT(near / near_count, 1.3 * far / far_count);
  EXPECT_GT(far / far_count, 0.0);
  // Bumps shorter than a pixel of the nearest ground are invisible.
  EXPECT_EQ(trace(made(12.0, 10.0), *camera).normal, smooth.normal);
  // Any part equals the whole.
  const SyntheticWorld world = made(12.0, 300.0);
  const PixelRect rect{17, 40, 70, 61};
  const GuidanceBuffers part = trace_guidance(world.terrain, world.surface, *world.tracer, *camera,
                                              {}, rect, silent_progress());
  for (const auto [x, y] : test::cells(rect.width(), rect.height()))
    ASSERT_EQ(part.normal(x, y), bumpy.normal(rect.x0 + x, rect.y0 + y));
}

// Forest has a ragged border with grass, within a cell or two of the map's border; a shore is not
// moved.
TEST(GuidanceGround, WhatGrowsHasRaggedBordersAndShoresKeepTheirs) {
  const auto border_of = [](LandCoverClass beyond) {
    const SyntheticWorld world = make_world(
        80, 80, [](double, double) { return 500.0; },
        [&](double x, double) { return x > 39.5 * cell ? LandCoverClass::forest : beyond; });
    std::vector<double> positions;  // columns of each row's border
    for (double row = 5.0; row < 75.0; row += 0.2) {
      int outside = 0;
      for (double column = 30.0; column < 50.0; column += 0.05) {
        const LandCoverClass id = class_at(world.terrain, column, row);
        outside += id == beyond ? 1 : 0;
        if (column < 36.0 || column > 43.0) {
          EXPECT_EQ(id, column > 39.5 ? LandCoverClass::forest : beyond) << column << ' ' << row;
        }
      }
      positions.push_back(30.0 + 0.05 * outside);
    }
    double sum = 0.0;
    double squares = 0.0;
    for (const double position : positions) sum += position, squares += position * position;
    const double mean = sum / static_cast<double>(positions.size());
    return std::pair(mean, std::sqrt(std::max(0.0, squares / static_cast<double>(positions.size()) -
                                                       mean * mean)));
  };
  const auto [grass, ragged] = border_of(LandCoverClass::pasture);
  EXPECT_NEAR(grass, 39.5, 0.35);
  EXPECT_GT(ragged, 0.5);
  EXPECT_LT(ragged, 1.3);
  const auto [shore, straight] = border_of(LandCoverClass::water);
  EXPECT_NEAR(shore, 39.5, 0.1);
  EXPECT_LT(straight, 0.03);
}

// Lines of a map keep their shape where a widened valley stretches their ground: they are read
// where lines are drawn, cells at the origin of the ground.
TEST(GuidanceGround, ARiverOfAMapLiesWhereLinesAreDrawn) {
  SyntheticWorld world = make_world(
      200, 200, [](double, double) { return 500.0; },
      [](double x, double) {
        return x > 2000.0 ? LandCoverClass::valley_floor : LandCoverClass::settlement;
      });
  const GeoTransform& transform = world.terrain.dem->transform;
  LandCover cover = *world.terrain.land_cover;
  const glm::dvec2 from = transform.to_crs(100.0, 20.0);
  const glm::dvec2 to = transform.to_crs(100.0, 180.0);
  lay_map(cover,
          std::make_shared<const MapCover>(
              std::vector<CoverArea>{},
              std::vector<CoverRiver>{{.positions = {from, to}, .half_width_m = {60.F, 60.F}}},
              transform.to_crs(0.0, 199.0), transform.to_crs(199.0, 0.0)));
  world.terrain.land_cover = std::make_shared<const LandCover>(std::move(cover));
  EXPECT_EQ(class_at(world.terrain, 100.0, 90.0), LandCoverClass::water);
  world.terrain.came_from = Grid<glm::vec2>(200, 200, glm::vec2(-3.F, 0.F));
  world.terrain.goes_to = Grid<glm::vec2>(200, 200, glm::vec2(10.F, 0.F));
  for (const double off : {-1.5, 0.0, 1.5})
    EXPECT_EQ(class_at(world.terrain, 110.0 + off, 90.0), LandCoverClass::water) << off;
  for (const double column : {100.0, 103.0, 106.0, 114.0})
    EXPECT_EQ(class_at(world.terrain, column, 90.0), LandCoverClass::valley_floor) << column;
  // Cells came from three columns farther west.
  EXPECT_EQ(class_at(world.terrain, 2000.0 / cell + 2.0, 90.0), LandCoverClass::settlement);
  EXPECT_EQ(class_at(world.terrain, 2000.0 / cell + 5.0, 90.0), LandCoverClass::valley_floor);
}

TEST(GuidanceGround, GroundThatMovedTakesAlongWhatLiesOnIt) {
  // The ground rises to the east, with a forest from 3 km on; all of it came from ten cells farther
  // west.
  SyntheticWorld world = make_world(
      200, 200, [](double x, double) { return 500.0 + 0.1 * x; },
      [](double x, double) {
        return x > 3000.0 ? LandCoverClass::forest : LandCoverClass::alpine_grass;
      });
  world.terrain.came_from = Grid<glm::vec2>(200, 200, glm::vec2(-10.F, 0.F));
  const GuidanceBuffers b = trace(world, *make_camera(southward(96, 64)));
  int forest = 0;
  int grass = 0;
  for (std::size_t i = 0; i < b.depth_m.size(); ++i) {
    if (b.is_sky(i)) continue;
    const double east = b.origin_m.x + b.position_m[i].x - 650015.0;  // from the first post
    if (east < 320.0 || east > 5900.0) continue;
    EXPECT_NEAR(b.altitude_m[i], 500.0 + 0.1 * (east - 300.0), 0.1);
    if (std::abs(east - 3300.0) < 100.0) continue;
    (east > 3300.0 ? forest : grass) += 1;
    EXPECT_EQ(b.land_cover[i],
              east > 3300.0 ? LandCoverClass::forest : LandCoverClass::alpine_grass)
        << east;
  }
  EXPECT_GT(forest, 200);
  EXPECT_GT(grass, 200);
}

}  // namespace
}  // namespace belvedere
