#include <gtest/gtest.h>

#include <cmath>

#include "tests/grids.h"
#include "tests/texture/strokes/stroke_picture.h"

namespace belvedere {
namespace {

constexpr int lake_width = 400;
constexpr int lake_height = 240;

// Level water at an altitude, with so many metres per pixel; land in the rows above 60.
Picture lake_picture(float altitude_m = 900.F, float footprint_m = 14.F) {
  Picture p = plain_picture(LandCoverClass::water, lake_width, lake_height);
  p.guidance.depth_m = Grid<float>(lake_width, lake_height, 9000.F);
  p.guidance.footprint_m = Grid<float>(lake_width, lake_height, footprint_m);
  p.guidance.slope_deg = Grid<float>(lake_width, lake_height, 0.F);
  for (const auto [x, y] : test::cells(lake_width, lake_height)) {
    p.guidance.position_m(x, y) = glm::vec3(footprint_m * static_cast<float>(x),
                                            -3.F * footprint_m * static_cast<float>(y), altitude_m);
    if (y < 60) p.guidance.land_cover(x, y) = LandCoverClass::pasture;
  }
  p.parameters.wind = 1.0;
  p.parameters.foam = true;
  p.parameters.surf_units = 1.0;
  return p;
}

TEST(WaterStrokes, StreaksLieLevelAndLightOnOpenWaterAlone) {
  const std::vector<Stroke> streaks = grow_strokes("wind streaks", lake_picture().scene());
  ASSERT_GT(streaks.size(), 40U);
  for (const Stroke& s : streaks) {
    EXPECT_LT(angle_deg(axis_of(s), {1.F, 0.F}), 5.0);
    EXPECT_GT(s.colour.g, 0.5F);
    EXPECT_EQ(s.gate, StrokeGate::water);
    EXPECT_GT(s.source / lake_width, 60U + 3U) << "not at the shore";
  }
}

double mean_length(const char* kind, const Picture& p) {
  const std::vector<Stroke> strokes = grow_strokes(kind, p.scene());
  double sum = 0.0;
  for (const Stroke& s : strokes)
    sum += static_cast<double>(glm::length(axis_of(s))) / static_cast<double>(strokes.size());
  return sum;
}

TEST(WaterStrokes, StreaksAreShorterFarAway) {
  const auto length = [](float m) { return mean_length("wind streaks", lake_picture(900.F, m)); };
  EXPECT_NEAR(length(56.F) / length(14.F), 0.5, 0.1);
}

TEST(WaterStrokes, CalmFrozenAndNarrowWaterHasNoStreaks) {
  Picture p = lake_picture();
  p.parameters.wind = 0.0;
  EXPECT_TRUE(grow_strokes("wind streaks", p.scene()).empty());
  p.parameters.wind = 1.0;
  p.parameters.frozen_from_m = 800.0;
  EXPECT_TRUE(grow_strokes("wind streaks", p.scene()).empty());
  Picture brook = lake_picture();
  for (const auto [x, y] : test::cells(lake_width, lake_height))
    if (y < 100 || y > 104) brook.guidance.land_cover(x, y) = LandCoverClass::pasture;
  EXPECT_TRUE(grow_strokes("wind streaks", brook.scene()).empty());
}

TEST(WaterStrokes, FallsAreWhiteAndRunDown) {
  Picture p = lake_picture();
  EXPECT_TRUE(grow_strokes("river foam", p.scene()).empty()) << "level water";
  for (float& slope : p.guidance.slope_deg) slope = 30.F;
  EXPECT_TRUE(grow_strokes("river foam", p.scene()).empty()) << "a lake below steep banks";
  for (glm::vec3& position : p.guidance.position_m) position.z += 0.6F * position.y;
  const std::vector<Stroke> foam = grow_strokes("river foam", p.scene());
  ASSERT_GT(foam.size(), 1000U);
  for (const Stroke& s : foam) {
    EXPECT_LT(angle_deg(axis_of(s), {0.F, 1.F}), 30.0);
    EXPECT_GT(s.colour.r, 0.8F);
  }
  p.parameters.foam = false;
  EXPECT_TRUE(grow_strokes("river foam", p.scene()).empty());
}

// Coarse cells extend a lake up its bank: rows 60 to 70 here, over level water.
TEST(WaterStrokes, TheBankOfALakeIsNoFall) {
  Picture lake = lake_picture();
  for (const auto [x, y] : test::cells({0, 60, lake_width, 70}))
    lake.guidance.position_m(x, y).z += 25.F * static_cast<float>(70 - y);
  EXPECT_TRUE(grow_strokes("river foam", lake.scene()).empty());
  // The same water as a river, which continues to fall.
  for (const auto [x, y] : test::cells({0, 70, lake_width, lake_height}))
    lake.guidance.position_m(x, y).z -= 25.F * static_cast<float>(y - 70);
  EXPECT_GT(grow_strokes("river foam", lake.scene()).size(), 1000U);
}

// Water has long strokes, ice is dabbed.
TEST(WaterStrokes, IceIsPaintedInShorterStrokesThanWater) {
  const auto length = [](double frozen_from_m) {
    Picture p = lake_picture();
    p.parameters.frozen_from_m = frozen_from_m;
    return mean_length("water", p);
  };
  EXPECT_LT(length(900.0), 0.5 * length(901.0));
}

// A brook runs diagonally over a wall, not down the wall's fall line.
TEST(WaterStrokes, ABrookIsWhiteAlongItsOwnWayOverAWall) {
  Picture p = lake_picture();
  std::size_t wet = 0;
  for (const auto [x, y] : test::cells(lake_width, lake_height)) {
    const bool brook = std::abs(x - y - 40) < 2;
    p.guidance.land_cover(x, y) = brook ? LandCoverClass::water : LandCoverClass::rock;
    p.guidance.position_m(x, y) = {14.F * static_cast<float>(x), -14.F * static_cast<float>(y),
                                   900.F - 14.F * static_cast<float>(y)};
    wet += brook ? 1 : 0;
  }
  const std::vector<Stroke> foam = grow_strokes("river foam", p.scene());
  double painted = 0.0;
  std::size_t down_the_wall = 0;
  for (const Stroke& s : foam) {
    down_the_wall += angle_deg(axis_of(s), {0.707F, 0.707F}) > 30.0 ? 1U : 0U;
    EXPECT_EQ(s.gate, StrokeGate::water);
    painted += static_cast<double>(glm::length(axis_of(s)) * s.start_width);
  }
  EXPECT_LT(down_the_wall, foam.size() / 5) << "of " << foam.size();
  EXPECT_GT(painted, 1.5 * static_cast<double>(wet)) << "all of it is white";
}

TEST(WaterStrokes, SurfRunsAlongTheSeaInABrokenLine) {
  EXPECT_TRUE(grow_strokes("sea surf", lake_picture(900.F).scene()).empty()) << "a lake";
  const std::vector<Stroke> surf = grow_strokes("sea surf", lake_picture(0.4F).scene());
  ASSERT_GT(surf.size(), 40U);
  Grid<std::uint8_t> white(lake_width, 1, 0);
  for (const Stroke& s : surf) {
    EXPECT_LT(angle_deg(axis_of(s), {1.F, 0.F}), 25.0);
    EXPECT_LT(s.points[0].y, 60.F + 2.5F) << "within 1.6 units of the shore";
    EXPECT_LE(s.start_width, 0.8F);
    for (int x = static_cast<int>(s.points[0].x); x < static_cast<int>(s.points[1].x); ++x)
      if (x >= 0 && x < lake_width) white(x, 0) = 1;
    for (int x = static_cast<int>(s.points[1].x); x < static_cast<int>(s.points[0].x); ++x)
      if (x >= 0 && x < lake_width) white(x, 0) = 1;
  }
  int covered = 0;
  for (const std::uint8_t is : white) covered += is;
  EXPECT_GT(covered, lake_width / 5);
  EXPECT_LT(covered, 9 * lake_width / 10) << "broken";
  // A farther shore has a thinner line: at most 120 m of ground.
  for (const Stroke& s : grow_strokes("sea surf", lake_picture(0.4F, 400.F).scene()))
    EXPECT_LE(s.start_width, 0.8F * 0.3F + 1e-4F);
}

// A hill in front of the sea has no surf along its crest.
TEST(WaterStrokes, WhatStandsBeforeTheSeaIsNoShore) {
  Picture p = lake_picture(0.4F);
  for (const auto [x, y] : test::cells(lake_width, 60)) p.guidance.depth_m(x, y) = 4000.F;
  EXPECT_TRUE(grow_strokes("sea surf", p.scene()).empty());
}

}  // namespace
}  // namespace belvedere
