#include "renderer/rock/rock_relief.h"

#include <gtest/gtest.h>

#include <map>

#include "base/parallel.h"
#include "base/progress.h"
#include "tests/grids.h"
#include "tests/renderer/paint/hills_print.h"
#include "tests/renderer/rock/rock_wall.h"

namespace belvedere {
namespace {

RockParameters parameters_of(double pixels_per_unit, const char* kind = "limestone") {
  RockParameters p;
  p.light.pixels_per_unit = pixels_per_unit;
  p.kind = &find_rock_kind(kind);
  return p;
}

RockRelief relief_of(const GuidanceBuffers& g, const RockParameters& p) {
  return make_rock_relief(g, {g, 1, {0, 0}}, p, {0, 0}, silent_progress());
}

void expect_same(const RockRelief& a, const RockRelief& b) {
  EXPECT_TRUE(a.land_cover == b.land_cover);
  EXPECT_TRUE(a.fall_line == b.fall_line);
  EXPECT_TRUE(a.height == b.height);
  EXPECT_TRUE(a.facet == b.facet);
  EXPECT_TRUE(a.tone == b.tone);
  EXPECT_TRUE(a.cover == b.cover);
}

RockRelief cut(const RockRelief& r, PixelRect rect) {
  return {test::cut(r.land_cover, rect), test::cut(r.fall_line, rect), test::cut(r.height, rect),
          test::cut(r.facet, rect),      test::cut(r.tone, rect),      test::cut(r.cover, rect)};
}

// Deviation of the tones of some rows.
double contrast_of(const RockRelief& relief, int first, int end) {
  double sum = 0.0;
  double squares = 0.0;
  for (const auto [x, y] : test::cells({0, first, relief.tone.width(), end})) {
    sum += relief.tone(x, y);
    squares += relief.tone(x, y) * relief.tone(x, y);
  }
  const double count = static_cast<double>(relief.tone.width()) * (end - first);
  return std::sqrt(squares / count - sum * sum / count / count);
}

TEST(RockRelief, WhereThereIsNoRockNothingChanges) {
  GuidanceBuffers g = test::make_wall(160, 120, 1.0, LandCoverClass::pasture);
  for (float& metres : g.footprint_m) metres = 40.0F;
  const RockRelief relief = relief_of(g, parameters_of(1.0));
  EXPECT_TRUE(relief.land_cover == g.land_cover);
  EXPECT_TRUE(relief.fall_line == g.fall_line);
  for (std::size_t i = 0; i < relief.facet.size(); ++i)
    ASSERT_TRUE(relief.facet[i] == 0 && relief.tone[i] == 0.0F && relief.height[i] == 0.0F);
}

TEST(RockRelief, AWallStandsInPlanes) {
  const GuidanceBuffers g = test::make_wall(300, 300, 2.0);
  const RockRelief relief = relief_of(g, parameters_of(2.0));
  std::map<std::uint32_t, int> planes;
  double edges = 0.0;
  for (const auto [x, y] : test::cells({1, 0, 300, 300})) {
    ++planes[relief.facet(x, y)];
    edges += relief.facet(x, y) != relief.facet(x - 1, y) ? 1.0 : 0.0;
  }
  // Planes some units wide and high: neither specks nor one slab.
  const double area_units = 300.0 * 299.0 / 4.0 / static_cast<double>(planes.size());
  EXPECT_GT(area_units, 15.0);
  EXPECT_LT(area_units, 250.0);
  EXPECT_LT(edges / (300.0 * 299.0), 0.25);
  EXPECT_GT(contrast_of(relief, 0, 300), 0.10) << "in light and shade";
}

TEST(RockRelief, StrokesRunDownThePlanes) {
  const GuidanceBuffers g = test::make_wall(200, 200, 1.0);
  const RockRelief relief = relief_of(g, parameters_of(1.0));
  std::map<std::uint32_t, glm::vec2> ways;
  int turned = 0;
  for (std::size_t i = 0; i < relief.facet.size(); ++i) {
    EXPECT_NEAR(std::hypot(relief.fall_line[i].x, relief.fall_line[i].y), 1.0F, 1e-4F);
    turned += std::abs(relief.fall_line[i].x) > 0.1F ? 1 : 0;
  }
  EXPECT_GT(turned, 200 * 200 / 3);
}

TEST(RockRelief, OfAPartIsThatOfTheWhole) {
  const test::Print print;
  RockParameters p = parameters_of(test::print_ppu);
  const RockRelief whole =
      make_rock_relief(print.near, {print.far, test::print_factor}, p, {0, 0}, silent_progress());
  bool any = false;
  for (const std::uint32_t facet : whole.facet) any = any || facet != 0;
  ASSERT_TRUE(any);
  for (const PixelRect kept :
       {PixelRect{640, 560, 700, 610}, PixelRect{0, 300, 3, 420}, PixelRect{900, 700, 901, 701}}) {
    const test::Window near = test::window_of(print.near, grown(kept, rock_near_margin_px(p)));
    const test::Window far =
        test::window_of(print.far, wide_rect(grown(kept, rock_margin_px(p)), test::print_factor));
    const RockRelief part = make_rock_relief(
        near.held, {far.held, test::print_factor, {far.rect.x0, far.rect.y0}}, p,
        {near.rect.x0, near.rect.y0}, silent_progress(), moved(kept, -near.rect.x0, -near.rect.y0));
    expect_same(part, cut(whole, kept));
  }
}

// The wide view misses rock of some pixels. What is compared with its neighbours at its border must
// not depend on what else the window shows.
TEST(RockRelief, OfALoneRockIsThatOfTheWhole) {
  GuidanceBuffers far = test::make_wall(460, 420, 1.0, LandCoverClass::pasture);
  for (float& metres : far.footprint_m) metres = 40.0F;  // near turf may be bare anywhere
  GuidanceBuffers g = far;
  const PixelRect lone{60, 60, 190, 380};  // long enough for planes to meet at its border
  for (const PixelRect rock : {lone, PixelRect{440, 20, 446, 46}})
    for (const auto [x, y] : test::cells(rock)) g.land_cover(x, y) = LandCoverClass::rock;
  const RockParameters p = parameters_of(1.0);
  const RockRelief whole = make_rock_relief(g, {far, 1, {0, 0}}, p, {0, 0}, silent_progress());
  const PixelRect kept = grown(lone, 20);
  const test::Window near = test::window_of(g, grown(kept, rock_near_margin_px(p)));
  const RockRelief part =
      make_rock_relief(near.held, {far, 1, {0, 0}}, p, {near.rect.x0, near.rect.y0},
                       silent_progress(), moved(kept, -near.rect.x0, -near.rect.y0));
  const RockRelief same = cut(whole, kept);
  expect_same(part, same);
  EXPECT_GT(std::count(same.land_cover.begin(), same.land_cover.end(), LandCoverClass::rock), 40);
}

// Near turf on a wall shows ribs of rock, and interlocks with rock beside it.
TEST(RockRelief, OfAPartOfNearTurfIsThatOfTheWhole) {
  GuidanceBuffers g = test::make_wall(1000, 760, 1.0, LandCoverClass::alpine_grass);
  for (float& metres : g.footprint_m) metres = 8.0F;
  for (const auto [x, y] : test::cells(g)) {
    g.slope_deg(x, y) = x < 500 ? 41.0F : 25.0F;
    if (x > 500 && y < 360) g.land_cover(x, y) = LandCoverClass::rock;
  }
  const RockParameters p = parameters_of(1.0);
  // Left of x = 500 ribs in steep turf, right of it the border of turf and rock.
  for (const PixelRect kept : {PixelRect{430, 380, 500, 440}, PixelRect{510, 340, 570, 380}}) {
    const RockRelief whole =
        make_rock_relief(g, {g, 1, {0, 0}}, p, {0, 0}, silent_progress(), kept);
    const auto moved_to = [&](LandCoverClass id) {
      int count = 0;
      for (const auto [x, y] : test::cells(kept.width(), kept.height()))
        count += whole.land_cover(x, y) == id && g.land_cover(kept.x0 + x, kept.y0 + y) != id;
      return count;
    };
    EXPECT_GT(moved_to(LandCoverClass::rock), kept.width() * kept.height() / 50);
    if (kept.x0 > 500) {
      EXPECT_GT(moved_to(LandCoverClass::alpine_grass), 0);
    }
    const test::Window near = test::window_of(g, grown(kept, rock_near_margin_px(p)));
    const test::Window far = test::window_of(g, grown(kept, rock_margin_px(p)));
    const RockRelief part = make_rock_relief(near.held, {far.held, 1, {far.rect.x0, far.rect.y0}},
                                             p, {near.rect.x0, near.rect.y0}, silent_progress(),
                                             moved(kept, -near.rect.x0, -near.rect.y0));
    expect_same(part, whole);
  }
}

TEST(RockRelief, LooksNoFartherThanItsMargins) {
  // A picture large enough for the margins to end inside it, at one pixel per unit.
  const GuidanceBuffers hills = test::make_hills(1300, 1200, 1.0);
  const RockParameters p = parameters_of(1.0);
  const RockRelief whole = relief_of(hills, p);
  const PixelRect kept{640, 600, 660, 616};
  const test::Window near = test::window_of(hills, grown(kept, rock_near_margin_px(p)));
  const test::Window far = test::window_of(hills, grown(kept, rock_margin_px(p)));
  ASSERT_GT(far.rect.x0, 0);
  ASSERT_LT(far.rect.y1, 1200);
  const RockRelief part = make_rock_relief(near.held, {far.held, 1, {far.rect.x0, far.rect.y0}}, p,
                                           {near.rect.x0, near.rect.y0}, silent_progress(),
                                           moved(kept, -near.rect.x0, -near.rect.y0));
  expect_same(part, cut(whole, kept));
}

TEST(RockRelief, SameBitsForAnyThreads) {
  const GuidanceBuffers hills = test::make_hills(200, 160, 1.0);
  const RockRelief many = relief_of(hills, parameters_of(1.0));
  const ThreadLimit one(1);
  expect_same(relief_of(hills, parameters_of(1.0)), many);
}

TEST(RockRelief, KindsOfRockDiffer) {
  const GuidanceBuffers g = test::make_wall(200, 200, 1.0);
  const RockRelief limestone = relief_of(g, parameters_of(1.0));
  for (const char* kind : {"granite", "sandstone", "volcanic"}) {
    const RockRelief other = relief_of(g, parameters_of(1.0, kind));
    int same = 0;
    for (std::size_t i = 0; i < other.tone.size(); ++i)
      same += other.tone[i] == limestone.tone[i] ? 1 : 0;
    EXPECT_LT(same, 200 * 200 / 50) << kind;
  }
}

// The wide view shows crests where they were before they rose, and meadows of the valley at their
// new position.
TEST(RockRelief, ARisenCrestIsLitAsTheWallBelowIt) {
  constexpr int factor = 8;
  constexpr int ridge = 20;  // of the wide view
  constexpr int rise = 4 * factor;
  GuidanceBuffers seen = test::make_wall(40, 60, 1.0);
  GuidanceBuffers g = test::make_wall(40 * factor, 60 * factor, factor);
  const auto put_valley = [](GuidanceBuffers& view, int end) {
    for (const auto [x, y] : test::cells(view.width(), end)) {
      view.depth_m(x, y) = 90000.0F;
      view.land_cover(x, y) = LandCoverClass::pasture;
    }
  };
  put_valley(seen, ridge);
  put_valley(g, ridge * factor - rise);
  const RockRelief relief =
      make_rock_relief(g, {seen, factor, {0, 0}}, parameters_of(factor), {0, 0}, silent_progress());
  for (const auto [x, y] : test::cells({0, ridge * factor - rise, g.width(), ridge * factor}))
    ASSERT_EQ(relief.land_cover(x, y), LandCoverClass::rock) << x << " " << y;
  // Rock far from other rock has no contrast, so it would be flat there.
  EXPECT_GT(contrast_of(relief, ridge * factor - rise, ridge * factor),
            0.6 * contrast_of(relief, ridge * factor, ridge * factor + rise));
}

}  // namespace
}  // namespace belvedere
