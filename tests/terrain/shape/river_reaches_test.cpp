#include "terrain/shape/river_reaches.h"

#include <gtest/gtest.h>

#include <cmath>

namespace belvedere {
namespace {

// A river down column 20 whose catchment grows by .1 km² a row, and a brook that comes along row 30
// from the west.
Grid<float> two_waters() {
  Grid<float> km2(41, 60, 0.5F);
  for (int y = 0; y < 60; ++y)
    km2(20, y) = 50.F + 0.1F * static_cast<float>(y) + (y >= 30 ? 30.F : 0.F);
  for (int x = 0; x < 20; ++x) km2(x, 30) = 20.F + 0.1F * static_cast<float>(x);
  return km2;
}

TEST(RiverReaches, AreLinkedDownTheWater) {
  const std::vector<RiverReach> reaches = find_reaches(two_waters(), 20.0);
  ASSERT_EQ(reaches.size(), 80U);
  std::size_t springs = 0;
  std::size_t mouths = 0;
  for (std::size_t i = 0; i < reaches.size(); ++i) {
    springs += reaches[i].upstream == no_reach ? 1 : 0;
    mouths += reaches[i].downstream == no_reach ? 1 : 0;
    if (reaches[i].downstream == no_reach) continue;
    const RiverReach& below = reaches[reaches[i].downstream];
    EXPECT_GT(below.catchment_km2, reaches[i].catchment_km2);
    EXPECT_LE(std::hypot(below.position.x - reaches[i].position.x,
                         below.position.y - reaches[i].position.y),
              1.5);
    // Where two meet, the larger one is upstream.
    EXPECT_EQ(reaches[below.upstream].position.x == 20.0, below.position.x == 20.0);
  }
  EXPECT_EQ(springs, 2U);
  EXPECT_EQ(mouths, 1U);
  EXPECT_EQ(find_reaches(two_waters(), 40.0).size(), 60U) << "the river alone";
}

TEST(RiverReaches, LoseTheStairsOfTheGridButNotTheirEnds) {
  // One column on in three rows: stairs of a cell.
  Grid<float> km2(60, 90, 0.F);
  for (int y = 0; y < 90; ++y) km2(10 + y / 3, y) = 100.F + static_cast<float>(y);
  std::vector<RiverReach> reaches = find_reaches(km2, 50.0);
  for (RiverReach& reach : reaches) reach.half_width_m = reach.position.y < 45.0 ? 10.0 : 20.0;
  smooth_reaches(reaches);
  EXPECT_EQ(reaches.front().position, glm::dvec2(10.0, 0.0));
  EXPECT_EQ(reaches.back().position, glm::dvec2(39.0, 89.0));
  for (const RiverReach& reach : reaches)
    if (reach.position.y > 10.0 && reach.position.y < 79.0) {
      EXPECT_NEAR(reach.position.x, 10.0 + (reach.position.y - 1.0) / 3.0, 0.12);
    }
  for (std::size_t i = 1; i < reaches.size(); ++i)
    EXPECT_LT(std::abs(reaches[i].half_width_m - reaches[i - 1].half_width_m), 1.5);
}

}  // namespace
}  // namespace belvedere
