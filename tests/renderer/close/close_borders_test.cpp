#include "renderer/close/close_borders.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "terrain/shape/mask_pieces.h"
#include "tests/grids.h"
#include "tests/renderer/close/close_ground.h"

namespace belvedere {
namespace {

using Class = LandCoverClass;

// Hills whose left and right halves are of two classes, with the borders drawn between them.
struct BorderScene {
  GuidanceBuffers g;
  WideView wide{g, 1, {0, 0}};
  Grid<glm::vec2> fall;
  SpurGround ground;
  IceAround ice;
  CloseBorders borders;

  explicit BorderScene(Class left, Class right, std::uint64_t seed = 7)
      : g(test::make_close_hills(160, 140, 1.0, 8.0, left, right)),
        fall(smooth_fall_lines(wide, 1.0, {0, 0, 160, 140})),
        ground{wide, fall, 1.0, seed},
        ice(look_around_ice(ground, {0, 0, 160, 140})),
        borders(make_close_borders(g, ground, ice, {0, 0}, {0, 0, 160, 140}, seed)) {}
  BorderScene(const BorderScene&) = delete;
  BorderScene& operator=(const BorderScene&) = delete;
};

// Where the border between the halves of a picture runs in each row, by the pixels of the left.
struct Border {
  int moved = 0;      // pixels that changed their class
  double mean = 0.0;  // of the left class's pixels in a row
  double farthest = 0.0;

  Border(Class left, Class right, float close) {
    const BorderScene scene(left, right);
    const GuidanceBuffers& g = scene.g;
    int rows = 0;
    for (int y = 0; y < 140; ++y) {
      if (g.is_sky(g.depth_m.index(80, y))) continue;
      int lefts = 0;
      for (int x = 0; x < 160; ++x) {
        const Class shown = scene.borders.at(x, y, close);
        lefts += shown == left ? 1 : 0;
        if (shown == g.land_cover(x, y)) continue;
        ++moved;
        farthest = std::max(farthest, std::abs(x - 79.5));
      }
      mean += lefts;
      ++rows;
    }
    mean /= rows;
  }
};

TEST(CloseBorders, FollowAReliefOrAreBrokenAndKeepAreas) {
  for (const Class left : {Class::scree, Class::forest}) {
    const Border border(left, Class::alpine_grass, 1.0F);
    EXPECT_GT(border.moved, left == Class::scree ? 50 : 100);
    EXPECT_LT(border.farthest, border_reach_units);
    EXPECT_NEAR(border.mean, 80.0, left == Class::scree ? 4.0 : 5.0);
  }
}

TEST(CloseBorders, StayStraightFarAwayAndBesideFieldsAndRock) {
  EXPECT_EQ(Border(Class::scree, Class::alpine_grass, 0.0F).moved, 0);
  EXPECT_EQ(Border(Class::forest, Class::alpine_grass, 0.0F).moved, 0);
  EXPECT_EQ(Border(Class::forest, Class::valley_floor, 1.0F).moved, 0);
  EXPECT_EQ(Border(Class::forest, Class::rock, 1.0F).moved, 0);
  EXPECT_EQ(Border(Class::rock, Class::snow, 1.0F).moved, 0) << "rock has borders of its own";
}

// Tufts stand before the edge of grass, and stones within: islands of either class in the other. In
// four of five cells of 2.8 units lies a patch, and of those within three units of the border about
// a quarter belong to a place beyond it: 140 units of border have 140 · 3 / 2.8² · .8 / 4 = 10 on
// either side. Half of them are left for those that grow together with the border's own teeth. Mean
// of some seeds.
TEST(CloseBorders, StrewOutliersOnBothSides) {
  constexpr int seeds = 4;
  const auto islands_of = [](Class left, Class right, std::uint64_t seed) {
    const BorderScene scene(left, right, seed);
    Grid<Class> shown(160, 140);
    for (const auto [x, y] : test::cells(160, 140))
      shown(x, y) = scene.g.is_sky(shown.index(x, y)) ? Class::sky : scene.borders.at(x, y, 1.0F);
    // Pieces of a class that do not reach an edge of the picture: of the left and of the right one.
    const auto spread = [&](Mask& mask, glm::ivec2 from) {
      const Class id = shown(from.x, from.y);
      mask(from.x, from.y) = 1;
      flood(mask, {from.y * 160 + from.x}, [&](int x, int y) { return shown(x, y) == id; });
    };
    Mask seen(160, 140, 0);
    for (int y = 0; y < 140; ++y)
      for (const int x : {0, 159}) spread(seen, {x, y});
    std::pair<int, int> count{0, 0};
    for (const auto [x, y] : test::cells(160, 140)) {
      if (seen(x, y) != 0 || (shown(x, y) != left && shown(x, y) != right)) continue;
      ++(shown(x, y) == left ? count.first : count.second);
      spread(seen, {x, y});
    }
    return count;
  };
  const auto islands = [&](Class left, Class right) {
    std::pair<int, int> sum{0, 0};
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const std::pair<int, int> count = islands_of(left, right, seed);
      sum.first += count.first;
      sum.second += count.second;
    }
    return sum;
  };
  const auto [stones, tufts] = islands(Class::scree, Class::alpine_grass);
  EXPECT_GE(stones, 5 * seeds);
  EXPECT_GE(tufts, 5 * seeds);
  const auto [firn, ice] = islands(Class::snow, Class::glacier);
  EXPECT_LT(firn + ice, (stones + tufts) / 3) << "snow and ice have no outliers";
}

// How often pixels show a class, by units right of the border; mean of some seeds.
std::vector<double> shares_beyond(Class left, Class right, Class wanted) {
  constexpr int seeds = 6;
  std::vector<double> shares(60, 0.0);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const BorderScene scene(left, right, seed);
    for (int x = 80; x < 140; ++x)
      for (int y = 20; y < 140; ++y)
        shares[static_cast<std::size_t>(x - 80)] +=
            scene.borders.at(x, y, 1.0F) == wanted ? 1.0 / (120.0 * seeds) : 0.0;
  }
  return shares;
}

TEST(CloseBorders, GroundThatIceHasLeftIsBare) {
  const std::vector<double> scree =
      shares_beyond(Class::glacier, Class::alpine_grass, Class::scree);
  EXPECT_GT(scree[3], 0.5);
  EXPECT_EQ(scree[40], 0.0);
  EXPECT_EQ(shares_beyond(Class::snow, Class::alpine_grass, Class::scree)[3], 0.0)
      << "old snow leaves turf";
}

TEST(CloseBorders, SnowLastsInTheGulliesAroundIt) {
  const std::vector<double> snow = shares_beyond(Class::snow, Class::scree, Class::snow);
  const auto mean = [&](std::size_t from, std::size_t to) {
    double sum = 0.0;
    for (std::size_t k = from; k < to; ++k) sum += snow[k] / static_cast<double>(to - from);
    return sum;
  };
  // Ten units from its edge about a quarter of what lies around is snow: it fills 1.5 units on
  // either side of gullies that are 38 units apart, 8 %; half of that, as some are hidden.
  EXPECT_GT(mean(8, 13), 0.04);
  EXPECT_LT(mean(8, 16), 0.5) << "gullies only";
  EXPECT_LT(mean(16, 26), mean(8, 16));
  EXPECT_EQ(mean(40, 60), 0.0);
}

TEST(CloseBorders, KnowTheirClasses) {
  EXPECT_TRUE(is_open_ground(Class::glacier));
  EXPECT_FALSE(is_open_ground(Class::valley_floor));
}

}  // namespace
}  // namespace belvedere
