#include "renderer/rock/rock_ground.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/grids.h"
#include "tests/renderer/paint/hills_print.h"
#include "tests/renderer/rock/rock_wall.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

TEST(RockGround, SpursStandInTheMeadowAndGulliesLetDebrisUp) {
  // Half rock, half meadow around; more rock above than below: the foot of a wall.
  const auto shown = [](LandCoverClass mapped, float stands) {
    return rock_border(
        {.mapped = mapped, .rock = 0.5F, .turf = 0.4F, .above = 0.6F, .stands = stands});
  };
  EXPECT_EQ(shown(rock, 0.4F), rock);
  EXPECT_EQ(shown(rock, -0.4F), scree);
  EXPECT_EQ(shown(alpine_grass, 0.4F), rock);
  EXPECT_EQ(shown(alpine_grass, -0.4F), alpine_grass);
  EXPECT_EQ(shown(scree, 0.4F), rock);
}

TEST(RockGround, NothingChangesFarFromABorder) {
  for (const float stands : {-0.6F, 0.6F}) {
    EXPECT_EQ(rock_border({.mapped = rock, .rock = 1.0F, .stands = stands}), rock);
    for (const LandCoverClass id : {alpine_grass, scree, snow, pasture, shrub})
      EXPECT_EQ(rock_border({.mapped = id, .rock = 0.03F, .stands = stands}), id);
  }
}

// Man-made classes, forest and water stay.
TEST(RockGround, WoodsWatersAndVillagesStay) {
  for (const LandCoverClass id : {forest, water, settlement, valley_floor, glacier})
    EXPECT_EQ(rock_border({.mapped = id, .rock = 0.8F, .stands = 0.6F}), id);
}

TEST(RockGround, WhereSnowIsNearItFillsTheGullies) {
  EXPECT_EQ(rock_border({.mapped = rock, .rock = 0.5F, .snow = 0.5F, .stands = -0.5F}), snow);
  EXPECT_EQ(rock_border({.mapped = rock,
                         .rock = 0.5F,
                         .turf = 0.6F,
                         .snow = 0.5F,
                         .above = 0.6F,
                         .stands = -0.5F}),
            scree);
  EXPECT_EQ(rock_border({.mapped = rock, .rock = 0.5F, .stands = -0.5F}), rock)
      << "an edge above grass: there is no debris";
}

TEST(RockGround, CrestsStandOutOfSteepSnow) {
  const auto at = [](float slope_deg, float stands) {
    return rock_border({.mapped = snow, .slope_deg = slope_deg, .stands = stands});
  };
  EXPECT_EQ(at(50.0F, 0.5F), rock);
  EXPECT_EQ(at(50.0F, -0.2F), snow);
  EXPECT_EQ(at(30.0F, 0.6F), snow);
}

// Near walls are steeper than their elevation data: ribs show on gentler ones, the broader the
// steeper; snow fills the gullies and hollows between, and whole walls.
TEST(RockGround, RibsOfNearWallsShowInSnow) {
  const auto at = [](float slope_deg, float rib, float funnel, float wall) {
    return rock_border({.mapped = snow,
                        .slope_deg = slope_deg,
                        .funnel = funnel,
                        .close = 1.0F,
                        .rib = rib,
                        .wall = wall});
  };
  EXPECT_EQ(at(38.0F, 0.9F, 0.0F, 0.0F), rock);
  EXPECT_EQ(at(38.0F, 0.0F, 0.0F, 0.0F), snow);
  EXPECT_EQ(at(38.0F, 0.45F, 0.0F, 0.0F), rock);
  EXPECT_EQ(at(34.0F, 0.45F, 0.0F, 0.0F), snow);
  EXPECT_EQ(at(34.0F, 0.45F, 1.0F, 0.5F), rock);
  EXPECT_EQ(at(38.0F, 0.45F, -1.0F, -1.0F), snow);
  EXPECT_EQ(at(12.0F, 1.0F, 1.5F, 1.5F), snow);
  const auto of_ice = [](float slope_deg, float close) {
    return rock_border(
        {.mapped = glacier, .slope_deg = slope_deg, .close = close, .rib = 0.9F, .wall = 0.5F});
  };
  EXPECT_EQ(of_ice(38.0F, 1.0F), rock);
  EXPECT_EQ(of_ice(38.0F, 0.0F), glacier);
  EXPECT_EQ(of_ice(24.0F, 1.0F), glacier);
  // Turf clings to steeper ground, and none of this is so from afar.
  for (const LandCoverClass id : {scree, alpine_grass, pasture, shrub}) {
    const auto of = [&](float slope_deg, float rib, float close) {
      return rock_border({.mapped = id, .slope_deg = slope_deg, .close = close, .rib = rib});
    };
    EXPECT_EQ(of(42.0F, 0.9F, 1.0F), rock);
    EXPECT_EQ(of(42.0F, 0.0F, 1.0F), id);
    EXPECT_EQ(of(31.0F, 0.9F, 1.0F), id);
    EXPECT_EQ(of(42.0F, 0.9F, 0.0F), id);
  }
}

// Beds lie one above the other with one dip, and stand out unlike far.
TEST(RockGround, BedsShapeRibsInTurf) {
  for (const float metres_per_unit : {3.0F, 11.0F}) {
    double sum = 0.0;
    double squares = 0.0;
    for (int k = 0; k < 4000; ++k) {
      const float bed = standing_bed(1000.0 + 0.7 * k, 5000.0, 900.0, metres_per_unit, 0.0F);
      ASSERT_LE(std::abs(bed), 1.0F);
      sum += static_cast<double>(bed);
      squares += static_cast<double>(bed) * bed;
    }
    EXPECT_NEAR(sum / 4000.0, 0.0, 0.3);
    EXPECT_GT(squares / 4000.0, 0.1);
    // Along its dip a bed stays the same.
    EXPECT_NEAR(standing_bed(1500.0, 0.0, 0.0, metres_per_unit, 0.0F),
                standing_bed(1500.0 - 26.0, 100.0, 0.0, metres_per_unit, 0.0F), 1e-4F);
  }
  const auto at = [](float bedded, float bed) {
    return rock_border({.mapped = alpine_grass, .rock = 0.45F, .bedded = bedded, .bed = bed});
  };
  EXPECT_EQ(at(0.0F, 1.0F), alpine_grass);
  EXPECT_EQ(at(1.0F, 1.0F), rock);
  EXPECT_EQ(at(1.0F, -1.0F), alpine_grass);
}

TEST(RockGround, DebrisReachesUpBeneathFunnels) {
  const auto at = [](float funnel, float cones) {
    return rock_border(
        {.mapped = rock, .rock = 0.5F, .above = 0.6F, .funnel = funnel, .cones = cones});
  };
  EXPECT_EQ(at(1.0F, 1.0F), rock);
  EXPECT_EQ(at(-1.5F, 1.0F), scree);
  EXPECT_EQ(at(-1.5F, 0.1F), rock);
}

TEST(RockGround, SharesAreOfTheOwnSurface) {
  GuidanceBuffers g = test::make_wall(120, 80, 1.0);
  // The right half is meadow, far behind.
  for (const auto [x, y] : test::cells({60, 0, 120, 80})) {
    g.land_cover(x, y) = alpine_grass;
    g.depth_m(x, y) *= 1.5F;
  }
  const RockAround around = look_around_rock({g, 1, {0, 0}}, 1.0, {0, 0, 120, 80});
  EXPECT_FLOAT_EQ(around.rock(58, 40), 1.0F);
  EXPECT_FLOAT_EQ(around.turf(58, 40), 0.0F);
  EXPECT_FLOAT_EQ(around.rock(61, 40), 0.0F);
  EXPECT_FLOAT_EQ(around.turf(61, 40), 1.0F);
}

constexpr int width = 320;
constexpr int height = 240;
constexpr int edge = 100;
constexpr double ppu = 2.0;

RockParameters parameters() {
  RockParameters p;
  p.light.pixels_per_unit = ppu;
  p.kind = &find_rock_kind("limestone");
  return p;
}

// A wall that ends in a level edge before a far meadow.
GuidanceBuffers level_edge(LandCoverClass of_wall = LandCoverClass::rock) {
  GuidanceBuffers g = test::make_wall(width, height, ppu, of_wall);
  g.front = Grid<float>(width, height, 1.0F);
  for (int x = 0; x < width; ++x) {
    g.front(x, edge) = 0.5F;
    for (int y = 0; y < edge; ++y) {
      g.depth_m(x, y) = 90000.0F;
      g.land_cover(x, y) = LandCoverClass::pasture;
    }
  }
  return g;
}

CrestShift shift_of(const GuidanceBuffers& g) {
  return shift_crests(g, {g, 1, {0, 0}}, parameters(), {0, 0}, {0, 0, width, height});
}

// The topmost row of the wall in a column.
int top_of(const GuidanceBuffers& g, int x) {
  int y = 0;
  while (g.depth_m(x, y) > 80000.0F) ++y;
  return y;
}

TEST(CrestShift, RaisesPinnaclesAndSinksNotches) {
  const GuidanceBuffers g = level_edge();
  const GuidanceBuffers shifted = gather_rows(g, shift_of(g), {0, 0, width, height});
  double sum = 0.0;
  double squares = 0.0;
  int highest = 0;
  int lowest = 0;
  for (int x = 0; x < width; ++x) {
    const int rise = edge - top_of(shifted, x);
    sum += rise;
    squares += rise * rise;
    highest = std::max(highest, rise);
    lowest = std::min(lowest, rise);
  }
  EXPECT_GT(std::sqrt(squares / width - sum * sum / width / width), 0.5 * ppu);
  EXPECT_GT(highest, 1.0 * ppu);
  EXPECT_LT(lowest, -0.5 * ppu);
  EXPECT_LE(highest, static_cast<int>(std::ceil(4.4 * ppu)));
  EXPECT_GE(lowest, -static_cast<int>(std::ceil(3.0 * ppu)));
  EXPECT_LT(std::abs(sum / width), 1.2 * ppu) << "the range keeps its height";
}

TEST(CrestShift, ShowsEveryPixelAsOneOfItsColumn) {
  const GuidanceBuffers g = level_edge();
  const CrestShift shift = shift_of(g);
  const GuidanceBuffers shifted = gather_rows(g, shift, {0, 0, width, height});
  for (const auto [x, y] : test::cells(width, height)) {
    const int row = y + shift.rows(x, y);
    ASSERT_LE(std::abs(row - y), crest_reach_px(ppu));
    ASSERT_EQ(shifted.depth_m(x, y), g.depth_m(x, row));
    ASSERT_EQ(shifted.land_cover(x, y), g.land_cover(x, row));
    ASSERT_EQ(shifted.position_m(x, y), g.position_m(x, row));
    ASSERT_GE(shifted.front(x, y), 0.0F);
    ASSERT_LE(shifted.front(x, y), 1.0F);
  }
  // Far from the edge nothing moves.
  for (int x = 0; x < width; ++x) {
    ASSERT_EQ(shift.rows(x, 60), 0);
    ASSERT_EQ(shift.rows(x, edge + 40), 0);
  }
}

TEST(CrestShift, LeavesEdgesOfMeadowsAndLowRims) {
  const GuidanceBuffers meadow = level_edge(LandCoverClass::alpine_grass);
  for (const std::int16_t rows : shift_of(meadow).rows) ASSERT_EQ(rows, 0);
  // Rock of four units in front of something nearer: too little to stretch.
  GuidanceBuffers rim = level_edge();
  for (const auto [x, y] : test::cells({0, edge + 8, width, height})) {
    rim.depth_m(x, y) = 20000.0F;
    rim.land_cover(x, y) = LandCoverClass::forest;
  }
  for (const std::int16_t rows : shift_of(rim).rows) ASSERT_EQ(rows, 0);
}

TEST(CrestShift, OfAPartIsThatOfTheWhole) {
  test::Print print;
  print.near.front = Grid<float>(print.width, print.height, 1.0F);
  RockParameters p = parameters();
  p.light.pixels_per_unit = test::print_ppu;
  const CrestShift whole = shift_crests(print.near, {print.far, test::print_factor}, p, {0, 0},
                                        {0, 0, print.width, print.height});
  int moved_pixels = 0;
  for (const std::int16_t rows : whole.rows) moved_pixels += rows != 0 ? 1 : 0;
  ASSERT_GT(moved_pixels, 1000);
  for (const PixelRect kept : {PixelRect{300, 380, 420, 520}, PixelRect{700, 250, 820, 420},
                               PixelRect{0, 600, 200, 700}}) {
    const int margin = crest_margin_px(test::print_ppu);
    const test::Window near =
        test::window_of(print.near, {kept.x0, kept.y0 - margin, kept.x1, kept.y1 + margin});
    const test::Window far = test::window_of(
        print.far, wide_rect(grown(kept, rock_view_margin_px(p) + margin), test::print_factor));
    const CrestShift part =
        shift_crests(near.held, {far.held, test::print_factor, {far.rect.x0, far.rect.y0}}, p,
                     {near.rect.x0, near.rect.y0}, moved(kept, -near.rect.x0, -near.rect.y0));
    EXPECT_TRUE(part.rows == test::cut(whole.rows, kept));
    EXPECT_TRUE(part.front == test::cut(whole.front, kept));
  }
}

}  // namespace
}  // namespace belvedere
