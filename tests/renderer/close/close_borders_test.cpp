#include "renderer/close/close_borders.h"

#include <gtest/gtest.h>

#include <optional>

#include "tests/renderer/close/close_ground.h"

namespace belvedere {
namespace {

using Class = LandCoverClass;

// Where the border between the halves of a picture runs in each row, by the pixels of the left.
// Hills whose left and right halves are of two classes, with the borders drawn between them.
struct BorderScene {
  GuidanceBuffers g;
  WideView wide{g, 1, {0, 0}};
  Grid<glm::vec2> fall;
  SpurGround ground;
  CloseBorders borders;

  BorderScene(Class left, Class right)
      : g(test::make_close_hills(160, 140, 1.0, 8.0, left, right)),
        fall(smooth_fall_lines(wide, 1.0, {0, 0, 160, 140})),
        ground{wide, fall, 1.0, 7},
        borders{g,
                ground,
                {0, 0},
                grow_roofs(ground, border_roofs, border_roofs_part, {0, 0, 160, 140},
                           [&](std::size_t i) { return std::optional(fall[i]); }),
                7} {}
  BorderScene(const BorderScene&) = delete;
  BorderScene& operator=(const BorderScene&) = delete;
};

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

TEST(CloseBorders, FollowAReliefAndKeepAreas) {
  const Border border(Class::scree, Class::alpine_grass, 1.0F);
  EXPECT_GT(border.moved, 50);
  EXPECT_LT(border.farthest, border_reach_units);
  EXPECT_NEAR(border.mean, 80.0, 4.0);
}

TEST(CloseBorders, StayStraightFarAwayAndBesideForest) {
  EXPECT_EQ(Border(Class::scree, Class::alpine_grass, 0.0F).moved, 0);
  EXPECT_EQ(Border(Class::forest, Class::alpine_grass, 1.0F).moved, 0);
  EXPECT_EQ(Border(Class::rock, Class::snow, 1.0F).moved, 0) << "rock has borders of its own";
}

// Tufts stand before the edge of grass, and stones within: pixels of another class than both
// neighbours three units away.
TEST(CloseBorders, StrewOutliersOnBothSides) {
  const auto outliers = [](Class left, Class right) {
    const BorderScene scene(left, right);
    const GuidanceBuffers& g = scene.g;
    const CloseBorders& borders = scene.borders;
    int count = 0;
    for (int y = 0; y < 140; ++y)
      for (int x = 66; x < 94; ++x) {
        if (g.is_sky(g.depth_m.index(x, y))) continue;
        const Class own = borders.at(x, y, 1.0F);
        const Class before = borders.at(x - 3, y, 1.0F);
        count += own != before && before == borders.at(x + 3, y, 1.0F) ? 1 : 0;
      }
    return count;
  };
  EXPECT_GT(outliers(Class::scree, Class::alpine_grass), 8);
  EXPECT_GT(outliers(Class::scree, Class::alpine_grass), 2 * outliers(Class::snow, Class::glacier));
}

TEST(CloseBorders, KnowTheirClasses) {
  EXPECT_TRUE(is_open_ground(Class::glacier));
  EXPECT_FALSE(is_open_ground(Class::valley_floor));
}

}  // namespace
}  // namespace belvedere
