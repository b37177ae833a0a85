#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "tests/grids.h"
#include "tests/texture/strokes/stroke_picture.h"

// Strokes for close views only: stones and tufts.
namespace belvedere {
namespace {

using enum LandCoverClass;

// Ground of one class in plan, `metres` wide, `px` pixels; a unit of the sheet covers `unit_m`.
Picture ground_of(LandCoverClass id, double metres, int px, double unit_m) {
  Picture p = plain_picture(id, px, px);
  const double pixel_m = metres / px;
  p.parameters.pixels_per_unit = unit_m / pixel_m;
  for (const auto [x, y] : test::cells(px, px)) {
    const std::size_t i = p.guidance.depth_m.index(x, y);
    p.guidance.depth_m[i] = 500.F;
    p.guidance.footprint_m[i] = static_cast<float>(pixel_m);
    p.guidance.position_m[i] = glm::vec3(pixel_m * (x + 0.5), -pixel_m * (y + 0.5), 900.0);
  }
  return p;
}

// Sizes of the stones, m: their shadows, the first stroke of each, are .84 of them long.
std::vector<double> stones(const Picture& p) {
  std::vector<double> sizes;
  for (const Stroke& stroke : grow_strokes("stones", p.scene()))
    if (std::abs(stroke.alpha - 0.56F) < 1e-3F)
      sizes.push_back(
          static_cast<double>(glm::length(axis_of(stroke)) / 0.84F * p.guidance.footprint_m[0]));
  return sizes;
}
double larger(const std::vector<double>& sizes, double m) {
  return static_cast<double>(
      std::count_if(sizes.begin(), sizes.end(), [&](double size) { return size > m; }));
}

TEST(CloseViews, NothingOfThemFromAfar) {
  for (const std::string_view kind : {"stones", "tufts"}) {
    EXPECT_GT(grow_strokes(kind, ground_of(alpine_grass, 120.0, 240, 0.5).scene()).size(), 100U)
        << kind;
    EXPECT_EQ(grow_strokes(kind, ground_of(alpine_grass, 6000.0, 240, 25.0).scene()).size(), 0U)
        << kind;
  }
  for (const LandCoverClass id : {forest, water, glacier, snow, rock, settlement, valley_floor}) {
    EXPECT_TRUE(grow_strokes("stones", ground_of(id, 120.0, 240, 0.5).scene()).empty());
    EXPECT_TRUE(grow_strokes("tufts", ground_of(id, 120.0, 240, 0.5).scene()).empty());
  }
}

// About .05 stones above one metre per square metre of scree, .05 / d² above d (multiplied by
// fields of stones and bare areas): the same at any distance and resolution.
TEST(CloseViews, SoManyStonesASquareMetreAtAnyResolution) {
  constexpr double metres = 150.0;
  std::vector<double> counts;
  for (const auto& [px, unit_m] : {std::pair{300, 0.5}, std::pair{600, 0.5}, std::pair{450, 0.5},
                                   std::pair{450, 0.4}, std::pair{750, 0.4}}) {
    // Fields of stones differ from seed to seed.
    Picture ground = ground_of(scree, metres, px, unit_m);
    std::vector<double> sizes;
    over_seeds(ground, [&] {
      const std::vector<double> more = stones(ground);
      sizes.insert(sizes.end(), more.begin(), more.end());
    });
    for (const double d : {1.0, 1.5, 2.0}) {
      const double expected =
          test_seeds * 0.05 * (1.0 / (d * d) - 1.0 / (2.5 * 2.5)) * metres * metres;
      EXPECT_NEAR(larger(sizes, d), expected, 0.2 * expected)
          << px << " px, " << unit_m << " m a unit, more than " << d << " m";
    }
    counts.push_back(larger(sizes, 1.0));
    EXPECT_NEAR(counts.back(), counts.front(), 0.05 * counts.front())
        << px << " px, " << unit_m << " m a unit";
    for (const double size : sizes) {
      ASSERT_GT(size, 1.79 * unit_m) << "smaller ones are grain";
      ASSERT_LT(size, 2.51);
    }
  }
}

// Blocks lie where debris ends, and on the grass below it, not up the slope.
TEST(CloseViews, BlocksLieAtTheFootOfDebris) {
  Picture p = ground_of(scree, 2400.0, 240, 10.0);
  for (const auto [x, y] : test::cells({0, 120, 240, 240}))
    p.guidance.land_cover(x, y) = alpine_grass;
  int foot = 0, above = 0, meadow = 0;
  over_seeds(p, [&] {
    for (const Stroke& stroke : grow_strokes("stones", p.scene())) {
      const float y = stroke.points[0].y;
      if (y > 100.F && y < 136.F)
        ++foot;
      else if (y < 84.F)
        ++above;
      else if (y > 156.F)
        ++meadow;
    }
  });
  EXPECT_GT(foot, 200);
  EXPECT_GT(foot, 2 * above);
  EXPECT_GT(foot, 4 * meadow);
  p.parameters.winter = true;
  EXPECT_TRUE(grow_strokes("stones", p.scene()).empty());
}

// A slope seen at a low angle has more ground per pixel, and as many stones on it.
TEST(CloseViews, GroundSeenAtALowAngleHoldsAsManyStones) {
  Picture p = ground_of(scree, 300.0, 600, 0.5);
  for (glm::vec3& position : p.guidance.position_m) position.y *= 2.F;
  const double expected = 0.05 * (1.0 - 1.0 / 6.25) * 300.0 * 600.0;
  EXPECT_NEAR(larger(stones(p), 1.0), expected, 0.2 * expected);
}

TEST(CloseViews, TuftsStandUpAndAreDrawnBeforeWhatLiesBehind) {
  const Picture p = ground_of(pasture, 60.0, 240, 0.25);
  const std::vector<Stroke> tufts = grow_strokes("tufts", p.scene());
  ASSERT_GT(tufts.size(), 400U);
  double up = 0.0;
  for (const Stroke& blade : tufts) {
    EXPECT_EQ(blade.gate, StrokeGate::upright);
    EXPECT_LT(blade.order, blade.depth_m);
    EXPECT_GT(blade.start_width, blade.end_width);
    up += axis_of(blade).y < 0.F ? 1.0 : 0.0;
  }
  EXPECT_EQ(up, static_cast<double>(tufts.size()));
}

// Trees, shrubs, tufts and stones are strokes, not instances of objects, and hold at 300 %: a sheet
// of three times the pixels has the same strokes, and ground three times nearer as dense ones, of
// which as many stand.
TEST(CloseViews, StrokesStayDenseAndUprightAtThreeHundredPercent) {
  struct Figures {
    double density = 0.0;  // strokes per square unit of the sheet
    double upright = 0.0;  // share of them
  };
  const auto look_at = [](std::string_view kind, LandCoverClass id, int px, double unit_m) {
    Picture p = ground_of(id, 36.0, px, unit_m);
    Figures out;
    double count = 0.0;
    constexpr int seeds = 3;
    for (p.parameters.seed = 1; p.parameters.seed <= seeds; ++p.parameters.seed)
      for (const Stroke& stroke : grow_strokes(kind, p.scene())) {
        count += 1.0;
        out.upright += stroke.gate == StrokeGate::upright ? 1.0 : 0.0;
      }
    out.upright /= std::max(count, 1.0);
    out.density = count / (seeds * (36.0 / unit_m) * (36.0 / unit_m));
    return out;
  };
  struct Case {
    std::string_view kind;
    LandCoverClass id;
    double min_density;
    double min_upright;
  };
  for (const Case& c : {Case{"forest trees", forest, .1, .5}, Case{"low bushes", shrub, .045, 1.0},
                        Case{"tufts", pasture, .01, 1.0}, Case{"stones", scree, .025, 1.0}}) {
    SCOPED_TRACE(c.kind);
    const Figures whole = look_at(c.kind, c.id, 240, .45);
    const Figures enlarged = look_at(c.kind, c.id, 720, .45);
    const Figures nearer = look_at(c.kind, c.id, 720, .15);
    EXPECT_NEAR(enlarged.density, whole.density, .1 * whole.density);
    EXPECT_NEAR(enlarged.upright, whole.upright, .02);
    EXPECT_GT(nearer.density, c.min_density);
    EXPECT_GT(nearer.density, .7 * whole.density);
    EXPECT_GE(nearer.upright, c.min_upright);
    EXPECT_NEAR(nearer.upright, whole.upright, .1);
  }
}

TEST(CloseViews, AWindowIsPaintedAsTheWhole) {
  const Picture p = ground_of(alpine_grass, 150.0, 300, 0.4);
  const StrokeLayers layers{
      .sky = false, .ground = false, .accents = false, .breaks = false, .upright = true};
  const Painting whole =
      paint_strokes(p.ground.colour, p.guidance, p.ground, layers, p.parameters, silent_progress());
  EXPECT_FALSE(whole.picture == p.ground.colour);
  const int margin = stroke_margin_px(layers, p.parameters);
  const PixelRect wanted{150, 140, 180, 165};
  const PixelRect held{std::max(0, wanted.x0 - margin), std::max(0, wanted.y0 - margin),
                       std::min(300, wanted.x1 + margin), std::min(300, wanted.y1 + margin)};
  const auto cut = [&](const auto& grid) {
    std::decay_t<decltype(grid)> part(held.width(), held.height());
    for (const auto [x, y] : test::cells(held.width(), held.height()))
      part(x, y) = grid(held.x0 + x, held.y0 + y);
    return part;
  };
  Picture w = p;
  w.guidance.depth_m = cut(p.guidance.depth_m);
  w.guidance.land_cover = cut(p.guidance.land_cover);
  w.guidance.fall_line = cut(p.guidance.fall_line);
  w.guidance.tone = cut(p.guidance.tone);
  w.guidance.position_m = cut(p.guidance.position_m);
  w.guidance.slope_deg = cut(p.guidance.slope_deg);
  w.guidance.footprint_m = cut(p.guidance.footprint_m);
  w.guidance.relief_s_m = cut(p.guidance.relief_s_m);
  w.guidance.built = cut(p.guidance.built);
  w.guidance.grain = cut(p.guidance.grain);
  w.ground.colour = cut(p.ground.colour);
  w.ground.darker = cut(p.ground.darker);
  w.ground.lighter = cut(p.ground.lighter);
  w.ground.accent = cut(p.ground.accent);
  w.ground.tree_density = cut(p.ground.tree_density);
  w.ground.haze = cut(p.ground.haze);
  const PixelRect inside{wanted.x0 - held.x0, wanted.y0 - held.y0, wanted.x1 - held.x0,
                         wanted.y1 - held.y0};
  const Painting part =
      paint_strokes(w.ground.colour, w.guidance, w.ground, layers, w.parameters, silent_progress(),
                    {.origin_px = {held.x0, held.y0}, .sheet_px = {300, 300}, .asked = inside});
  for (const auto [x, y] : test::cells(wanted))
    ASSERT_EQ(part.picture(x - held.x0, y - held.y0), whole.picture(x, y)) << x << ", " << y;
}

}  // namespace
}  // namespace belvedere
