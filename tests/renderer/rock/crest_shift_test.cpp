#include "renderer/rock/crest_shift.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/renderer/paint/hills_print.h"
#include "tests/renderer/rock/rock_wall.h"

namespace belvedere {
namespace {

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
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
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
  for (int y = edge + 8; y < height; ++y)
    for (int x = 0; x < width; ++x) {
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
