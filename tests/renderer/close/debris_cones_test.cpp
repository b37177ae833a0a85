#include "renderer/close/debris_cones.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/grids.h"
#include "tests/renderer/close/close_ground.h"

namespace belvedere {
namespace {

using Class = LandCoverClass;

constexpr int width = 420;
constexpr int height = 300;
constexpr int foot_of_rock = 130;

// Steep ground: rock in its upper part, another class below.
struct Wall {
  GuidanceBuffers g;
  WideView wide{g, 1, {0, 0}};
  Grid<glm::vec2> fall;
  SpurGround ground;

  explicit Wall(Class above = Class::rock, Class below = Class::scree)
      : g(test::make_slope(width, height, below, glm::normalize(glm::vec3(0.0F, -0.5F, 0.8F)),
                           32.0F)),
        fall(width, height, glm::vec2(0.0F, 1.0F)),
        ground{wide, fall, 1.0, 5} {
    for (const auto [x, y] : test::cells(width, height)) {
      g.footprint_m(x, y) = 6.0F;
      g.fall_line(x, y) = {0.0F, 1.0F};
      if (y < foot_of_rock) g.land_cover(x, y) = above;
    }
  }
};

TEST(DebrisCones, StartAtTheFootOfRockAndSpreadDown) {
  const Wall wall;
  const DebrisCones grown = grow_debris_cones(wall.ground, {0, 0, width, height});
  ASSERT_GT(grown.cones.size(), 4U);
  for (const DebrisCone& cone : grown.cones) {
    EXPECT_NEAR(cone.apex.y, static_cast<float>(foot_of_rock), 4.0F);
    EXPECT_NEAR(cone.down.y, 1.0F, 1e-3F);
    const auto width_at = [&](float along) {
      const DebrisHit hit = debris_at(grown, 5, cone.apex + cone.down * (along * cone.length),
                                      wall.g.depth_m(200, 150));
      return hit.cone == &cone ? hit.half_width : -1.0F;
    };
    const float high = width_at(0.2F);
    const float low = width_at(0.6F);
    if (high > 0.0F && low > 0.0F) {
      EXPECT_GT(low, 1.8F * high);
    }
    EXPECT_GE(cone.channel_count, 2);
  }
  for (const DebrisCone& cone : grown.cones)
    for (const DebrisCone& other : grown.cones)
      if (cone.id != other.id) {
        EXPECT_GT(glm::distance(cone.apex, other.apex), 14.9F);
      }
}

TEST(DebrisCones, NoneWithoutAWall) {
  const Wall meadow(Class::scree, Class::alpine_grass);
  EXPECT_TRUE(grow_debris_cones(meadow.ground, {0, 0, width, height}).cones.empty());
  const DebrisHit none = debris_at({}, 5, {10.0F, 10.0F}, 100.0F);
  EXPECT_EQ(none.cone, nullptr);
  EXPECT_FALSE(debris_covers(none));
}

// Their sides fall away from the axis, and their channels are grooves.
TEST(DebrisCones, AreConvex) {
  const Wall wall;
  const DebrisCones grown = grow_debris_cones(wall.ground, {0, 0, width, height});
  double away = 0.0;
  int count = 0;
  for (const auto [x, y] : test::cells({0, foot_of_rock + 10, width, height}, 3)) {
    const DebrisHit hit =
        debris_at(grown, 5, {static_cast<float>(x), static_cast<float>(y)}, wall.g.depth_m(x, y));
    if (hit.cone == nullptr || std::abs(hit.across) < 0.5F || hit.along < 0.3F) continue;
    // To the right of an axis that points down the sheet.
    away += static_cast<double>(hit.across > 0.0F ? hit.slope.x : -hit.slope.x);
    ++count;
  }
  ASSERT_GT(count, 100);
  EXPECT_LT(away / count, -0.25);
}

TEST(DebrisCones, OfAPartAreThoseOfTheWhole) {
  const Wall wall;
  const DebrisCones whole = grow_debris_cones(wall.ground, {0, 0, width, height});
  const DebrisCones part = grow_debris_cones(wall.ground, {180, 140, 230, 200});
  int inside = 0;
  for (const auto [x, y] : test::cells({180, 140, 230, 200})) {
    const glm::vec2 position(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    const float depth_m = wall.g.depth_m(x, y);
    const DebrisHit a = debris_at(whole, 5, position, depth_m);
    const DebrisHit b = debris_at(part, 5, position, depth_m);
    ASSERT_EQ(a.cone == nullptr, b.cone == nullptr);
    EXPECT_EQ(a.tone, b.tone);
    EXPECT_EQ(a.slope, b.slope);
    EXPECT_EQ(a.inside, b.inside);
    EXPECT_EQ(a.beside, b.beside);
    inside += a.cone != nullptr ? 1 : 0;
  }
  EXPECT_GT(inside, 200);
}

// Grass is covered near the head, and in tongues towards the foot.
TEST(DebrisCones, LeaveGrassAtTheirFeet) {
  const Wall wall;
  const DebrisCones grown = grow_debris_cones(wall.ground, {0, 0, width, height});
  int high = 0, covered_high = 0, low = 0, covered_low = 0;
  for (const auto [x, y] : test::cells({0, foot_of_rock, width, height})) {
    const DebrisHit hit =
        debris_at(grown, 5, {static_cast<float>(x), static_cast<float>(y)}, wall.g.depth_m(x, y));
    if (hit.cone == nullptr || hit.inside < 0.9F) continue;
    const bool covers = debris_covers(hit);
    if (hit.along > 0.1F && hit.along < 0.4F) {
      ++high;
      covered_high += covers ? 1 : 0;
    } else if (hit.along > 0.8F) {
      ++low;
      covered_low += covers ? 1 : 0;
    }
  }
  ASSERT_GT(high, 300);
  ASSERT_GT(low, 300);
  EXPECT_GT(covered_high, 0.98 * high);
  EXPECT_LT(covered_low, 0.8 * low);
  EXPECT_GT(covered_low, 0.1 * low);
}

// Hard rock gives few and short cones, and a low wall gives short ones.
TEST(DebrisCones, AreThoseOfTheirWall) {
  const auto mean_length = [](const DebrisCones& grown) {
    double sum = 0.0;
    for (const DebrisCone& cone : grown.cones) sum += static_cast<double>(cone.length);
    return sum / static_cast<double>(std::max<std::size_t>(grown.cones.size(), 1));
  };
  const PixelRect rect{0, 0, width, height};
  const Wall wall;
  const DebrisCones loose = grow_debris_cones(wall.ground, rect);
  const DebrisCones hard = grow_debris_cones(wall.ground, rect, 0.7F);
  ASSERT_FALSE(hard.cones.empty());
  EXPECT_LT(hard.cones.size(), loose.cones.size());
  // .4 + .6 · .7 = .82 of their length, give or take that of twenty cones.
  EXPECT_LT(mean_length(hard), 0.95 * mean_length(loose));
  Wall low;
  constexpr int wall_units = 24;
  for (const auto [x, y] : test::cells(width, foot_of_rock - wall_units))
    low.g.land_cover(x, y) = Class::alpine_grass;
  const DebrisCones small = grow_debris_cones(low.ground, rect);
  ASSERT_FALSE(small.cones.empty());
  for (const DebrisCone& cone : small.cones) EXPECT_LE(cone.length, 12.0F + 1.1F * 32.0F);
}

}  // namespace
}  // namespace belvedere
