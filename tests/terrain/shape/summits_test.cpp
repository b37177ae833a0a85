#include "terrain/shape/summits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "terrain/io/dem.h"

namespace belvedere {
namespace {

using testing::ElementsAre;
using testing::FieldsAre;
using testing::IsEmpty;

// Ground of cones 10 m down a cell, the highest of them counts.
struct Cone {
  int x, y;
  float top_m;
};
Grid<float> cones(int width, int height, const std::vector<Cone>& tops) {
  Grid<float> ground(width, height, 0.F);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const Cone& cone : tops)
        ground(x, y) = std::max(
            ground(x, y), cone.top_m - 10.F * static_cast<float>(std::max(std::abs(x - cone.x),
                                                                          std::abs(y - cone.y))));
  return ground;
}

// Two cones 20 cells apart, 300 and 200 m high: at the saddle both are as high, 300 - 10 a = 200 -
// 10 (20 - a), a = 15, at 150 m.
TEST(Summits, ProminenceIsHeightOverTheSaddleToHigherGround) {
  EXPECT_THAT(
      find_summits(cones(60, 40, {{15, 20, 300.F}, {35, 20, 200.F}}), {.min_prominence_m = 20.0}),
      ElementsAre(FieldsAre(15, 20, 300.F, 300.F), FieldsAre(35, 20, 200.F, 50.F)));
}

// Of three in a row the middle one's way to the highest leads over its own saddle, the last one's
// over both: the lower saddle counts.
TEST(Summits, TheWayGoesOverLowerSummits) {
  const std::vector<Summit> found =
      find_summits(cones(100, 40, {{20, 20, 300.F}, {50, 20, 200.F}, {70, 20, 260.F}}),
                   {.min_prominence_m = 20.0});
  // 300 - 10 a = 200 - 10 (30 - a): a = 20, 100 m; between the others 200 - 10 a = 260 - 10 (20 -
  // a): a = 7, 130 m.
  EXPECT_THAT(found, ElementsAre(FieldsAre(20, 20, 300.F, 300.F), FieldsAre(70, 20, 260.F, 160.F),
                                 FieldsAre(50, 20, 200.F, 70.F)));
}

TEST(Summits, LeastProminenceAndMostAreHeldTo) {
  const Grid<float> ground = cones(60, 40, {{15, 20, 300.F}, {35, 20, 200.F}});
  EXPECT_EQ(find_summits(ground, {.min_prominence_m = 50.0}).size(), 2U);
  EXPECT_EQ(find_summits(ground, {.min_prominence_m = 50.5}).size(), 1U);
  EXPECT_EQ(find_summits(ground, {.min_prominence_m = 20.0, .max = 1}).front().altitude_m, 300.F);
}

TEST(Summits, GroundThatGoesOnBeyondTheDataIsNone) {
  EXPECT_THAT(find_summits(cones(40, 40, {{0, 20, 300.F}})), IsEmpty());
  Grid<float> ground = cones(40, 40, {{20, 20, 300.F}});
  EXPECT_EQ(find_summits(ground).size(), 1U);
  ground(21, 20) = NAN;
  EXPECT_THAT(find_summits(ground, {.min_prominence_m = 150.0}), IsEmpty());
}

TEST(Summits, LevelTopsAreOneAndLevelLandHasNone) {
  Grid<float> ground = cones(40, 40, {{20, 20, 300.F}});
  ground(21, 20) = ground(20, 21) = ground(21, 21) = 300.F;
  EXPECT_THAT(find_summits(ground), ElementsAre(FieldsAre(20, 20, 300.F, 200.F)))
      << "the corner is 20 cells away";
  EXPECT_THAT(find_summits(Grid<float>(20, 20, 500.F)), IsEmpty());
  EXPECT_THAT(find_summits(Grid<float>()), IsEmpty());
}

TEST(Summits, LandBelowTheSeaRanksByItsHeight) {
  Grid<float> ground = cones(60, 40, {{15, 20, 300.F}, {35, 20, 200.F}});
  for (float& z : ground) z -= 400.F;
  EXPECT_THAT(find_summits(ground, {.min_prominence_m = 20.0}),
              ElementsAre(FieldsAre(15, 20, -100.F, 300.F), FieldsAre(35, 20, -200.F, 50.F)));
}

}  // namespace
}  // namespace belvedere
