#include "texture/strokes/brush.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

// A canvas of 60 × 40 on one flat surface 1000 m away, class pasture, tone .5.
GuidanceBuffers flat_guidance(int width = 60, int height = 40) {
  GuidanceBuffers g;
  g.depth_m = Grid<float>(width, height, 1000.F);
  g.land_cover = Grid<LandCoverClass>(width, height, LandCoverClass::pasture);
  g.tone = Grid<float>(width, height, 0.5F);
  return g;
}

Stroke horizontal_stroke() {
  Stroke s{.points = {glm::vec2(10.F, 20.F), glm::vec2(50.F, 20.F)}, .point_count = 2};
  s.start_width = s.end_width = 4.F;
  s.colour = glm::vec3(1.F);
  s.depth_m = 1000.F;
  return s;
}

double painted_area(const Grid<glm::vec3>& canvas) {
  double sum = 0.0;
  for (const glm::vec3& p : canvas) sum += p.x;
  return sum;
}

Grid<glm::vec3> paint(const std::vector<Stroke>& strokes, const GuidanceBuffers& g) {
  Painting painting = begin_painting(Grid<glm::vec3>(g.width(), g.height(), glm::vec3(0.F)));
  paint_in_order(painting, g, strokes, 1.0, silent_progress());
  return painting.picture;
}

// Pasture left of x = 30, rock right of it, and water in row 20 from x = 40 on.
GuidanceBuffers border_guidance() {
  GuidanceBuffers g = flat_guidance();
  for (const auto [x, y] : test::cells({30, 0, g.width(), g.height()}))
    g.land_cover(x, y) = y == 20 && x >= 40 ? LandCoverClass::water : LandCoverClass::rock;
  return g;
}

Grid<std::uint32_t> sources_of(const std::vector<Stroke>& strokes, const GuidanceBuffers& g) {
  Painting painting = begin_painting(Grid<glm::vec3>(g.width(), g.height(), glm::vec3(0.F)));
  paint_in_order(painting, g, strokes, 1.0, silent_progress());
  return painting.sources;
}

TEST(Brush, TellsWhosePaintLiesOnAPixel) {
  const GuidanceBuffers g = border_guidance();
  Stroke grass = horizontal_stroke();
  grass.alpha = 0.8F;
  grass.source = static_cast<std::uint32_t>(g.depth_m.index(10, 20));
  const auto sources = sources_of({grass}, g);
  EXPECT_EQ(sources(35, 19), grass.source) << "grass over the border";
  EXPECT_EQ(sources(20, 19), g.depth_m.index(20, 19)) << "grass on grass is its own";
  EXPECT_EQ(sources(35, 30), g.depth_m.index(35, 30)) << "nothing painted";
  EXPECT_EQ(sources(45, 20), g.depth_m.index(45, 20)) << "water keeps its shores";
}

// Paint copied as water must look like water, whatever its origin.
TEST(Brush, TellsOfPaintOnWaterWhereItIsToBeCopied) {
  const GuidanceBuffers g = border_guidance();
  const auto painted = [&](float alpha) {
    Stroke grass = horizontal_stroke();
    grass.alpha = alpha;
    grass.source = static_cast<std::uint32_t>(g.depth_m.index(10, 20));
    Painting painting = begin_painting(Grid<glm::vec3>(g.width(), g.height(), glm::vec3(0.F)));
    paint_in_order(painting, g, {grass}, 1.0, silent_progress(), {.to_copy_from = true});
    return painting;
  };
  const auto grass = static_cast<std::uint32_t>(g.depth_m.index(10, 20));
  EXPECT_EQ(painted(0.8F).sources(45, 20), grass);
  const Painting thin = painted(0.4F);
  EXPECT_EQ(thin.sources(45, 20), g.depth_m.index(45, 20));
  EXPECT_EQ(thin.under(45, 20), grass);
  EXPECT_EQ(thin.under_share(45, 20), 102) << ".4 of 255";
}

// Three strokes of grass on grass, .5, .6 and .2: their visible shares are .5 · .4 · .8 = .16, .6 ·
// .8 = .48 and .2.
TEST(Brush, TellsOfTheThickestStrokeOfAClassWhereItIsToBeCopied) {
  const GuidanceBuffers g = border_guidance();
  std::vector<Stroke> strokes(3, horizontal_stroke());
  const float alphas[] = {0.5F, 0.6F, 0.2F};
  for (int i = 0; i < 3; ++i) {
    strokes[static_cast<std::size_t>(i)].alpha = alphas[i];
    strokes[static_cast<std::size_t>(i)].source =
        static_cast<std::uint32_t>(g.depth_m.index(10 + i, 20));
    strokes[static_cast<std::size_t>(i)].order = static_cast<float>(3 - i);
  }
  Painting painting = begin_painting(Grid<glm::vec3>(g.width(), g.height(), glm::vec3(0.F)));
  paint_in_order(painting, g, strokes, 1.0, silent_progress(), {.to_copy_from = true});
  EXPECT_EQ(painting.sources(20, 19), g.depth_m.index(11, 20));
  EXPECT_EQ(painting.under_share(20, 19), 0) << "all of one class";
  EXPECT_EQ(painting.sources(20, 30), g.depth_m.index(20, 30)) << "bare canvas";
}

TEST(Brush, ThinPaintDoesNotHideWhatLiesBelow) {
  const GuidanceBuffers g = border_guidance();
  Stroke grass = horizontal_stroke();
  grass.alpha = 0.4F;
  grass.source = static_cast<std::uint32_t>(g.depth_m.index(10, 20));
  EXPECT_EQ(sources_of({grass}, g)(35, 19), g.depth_m.index(35, 19));
  // Two thin layers: .4 leaves .6 of the rock, another .36, which is less than the grass's own .4
  // then.
  EXPECT_EQ(sources_of({grass, grass}, g)(35, 19), grass.source);
}

TEST(Brush, RecordsTheClassBesideTheThickest) {
  const GuidanceBuffers g = border_guidance();
  Stroke grass = horizontal_stroke();
  grass.source = static_cast<std::uint32_t>(g.depth_m.index(10, 20));
  const auto painted = [&](const std::vector<Stroke>& strokes) {
    Painting painting = begin_painting(Grid<glm::vec3>(g.width(), g.height(), glm::vec3(0.F)));
    paint_in_order(painting, g, strokes, 1.0, silent_progress());
    return painting;
  };
  const auto rock_pixel = static_cast<std::uint32_t>(g.depth_m.index(35, 19));
  grass.alpha = 0.4F;
  const Painting thin = painted({grass});
  EXPECT_EQ(thin.under(35, 19), grass.source);
  EXPECT_EQ(thin.under_share(35, 19), 102) << ".4 of 255";
  EXPECT_EQ(thin.under_share(20, 19), 0) << "grass on grass";
  EXPECT_EQ(thin.under(20, 19), g.depth_m.index(20, 19));
  EXPECT_EQ(thin.under_share(35, 30), 0) << "nothing painted";
  EXPECT_EQ(thin.under_share(45, 20), 0) << "water keeps its shores";
  // Two layers leave .6² = .36 of the rock, which is then the lower class.
  const Painting thick = painted({grass, grass});
  EXPECT_EQ(thick.sources(35, 19), grass.source);
  EXPECT_EQ(thick.under(35, 19), rock_pixel);
  EXPECT_EQ(thick.under_share(35, 19), 92);
  // A third class over both: .5 of it, .3 rock, .2 grass. The thinnest is dropped: .3 of .8.
  Stroke gravel = grass;
  gravel.alpha = 0.5F;
  gravel.source = static_cast<std::uint32_t>(g.depth_m.index(0, 0));
  GuidanceBuffers three = g;
  three.land_cover(0, 0) = LandCoverClass::scree;
  Painting mixed = begin_painting(Grid<glm::vec3>(g.width(), g.height(), glm::vec3(0.F)));
  paint_in_order(mixed, three, {grass, gravel}, 1.0, silent_progress());
  EXPECT_EQ(mixed.sources(35, 19), gravel.source);
  EXPECT_EQ(mixed.under(35, 19), rock_pixel);
  EXPECT_EQ(mixed.under_share(35, 19), 96);
}

TEST(Brush, LaterStrokesBuildOnTheSharesOfEarlierOnes) {
  const GuidanceBuffers g = border_guidance();
  Stroke grass = horizontal_stroke();
  grass.alpha = 0.4F;
  grass.source = static_cast<std::uint32_t>(g.depth_m.index(10, 20));
  Painting painting = begin_painting(Grid<glm::vec3>(g.width(), g.height(), glm::vec3(0.F)));
  paint_in_order(painting, g, {grass}, 1.0, silent_progress());
  paint_in_order(painting, g, {grass}, 1.0, silent_progress());
  EXPECT_EQ(painting.sources(35, 19), grass.source);
  EXPECT_NEAR(painting.under_share(35, 19), 92, 1);
}

TEST(Brush, CoversTheAreaOfItsOutline) {
  // A rectangle of 40 × 4 with two half discs of radius 2.
  EXPECT_NEAR(painted_area(paint({horizontal_stroke()}, flat_guidance())),
              40.0 * 4.0 + 3.14159 * 4.0, 2.5);
}

TEST(Brush, AHairlineKeepsItsAreaNotItsWidth) {
  Stroke hair = horizontal_stroke();
  hair.start_width = hair.end_width = 0.2F;
  // Between two rows of pixels, and along the centre of one, where its width would be fully
  // visible.
  EXPECT_NEAR(painted_area(paint({hair}, flat_guidance())), 40.0 * 0.2, 0.4);
  for (auto& p : hair.points) p.y += 0.5F;
  EXPECT_NEAR(painted_area(paint({hair}, flat_guidance())), 40.0 * 0.2, 0.4);
}

TEST(Brush, StaysOnItsOwnSurface) {
  GuidanceBuffers g = flat_guidance();
  for (const auto [x, y] : test::cells({30, 0, g.width(), g.height()})) g.depth_m(x, y) = 1100.F;
  const auto canvas = paint({horizontal_stroke()}, g);
  EXPECT_FLOAT_EQ(canvas(20, 20).x, 1.F);
  EXPECT_FLOAT_EQ(canvas(40, 20).x, 0.F);
}

TEST(Brush, UprightStrokesCoverWhatIsFartherAndNeverWhatIsNearer) {
  GuidanceBuffers g = flat_guidance();
  for (int y = 0; y < g.height(); ++y) {
    for (int x = 0; x < 25; ++x) g.depth_m(x, y) = std::numeric_limits<float>::infinity();
    for (int x = 40; x < g.width(); ++x) g.depth_m(x, y) = 900.F;
  }
  Stroke tree = horizontal_stroke();
  tree.gate = StrokeGate::upright;
  const auto canvas = paint({tree}, g);
  EXPECT_FLOAT_EQ(canvas(15, 20).x, 1.F);
  EXPECT_FLOAT_EQ(canvas(30, 20).x, 1.F);
  EXPECT_FLOAT_EQ(canvas(45, 20).x, 0.F);
}

TEST(Brush, WaterAndSkyGatesHold) {
  GuidanceBuffers g = flat_guidance();
  for (int y = 0; y < g.height(); ++y) {
    for (int x = 0; x < 20; ++x) g.land_cover(x, y) = LandCoverClass::water;
    for (int x = 40; x < g.width(); ++x) g.depth_m(x, y) = std::numeric_limits<float>::infinity();
  }
  Stroke s = horizontal_stroke();
  s.gate = StrokeGate::water;
  const auto water = paint({s}, g);
  EXPECT_FLOAT_EQ(water(15, 20).x, 1.F);
  EXPECT_FLOAT_EQ(water(30, 20).x, 0.F);
  s.gate = StrokeGate::sky;
  const auto sky = paint({s}, g);
  EXPECT_FLOAT_EQ(sky(45, 20).x, 1.F);
  EXPECT_FLOAT_EQ(sky(30, 20).x, 0.F);
}

TEST(Brush, StaysOnItsOwnClass) {
  const GuidanceBuffers g = border_guidance();
  Stroke line = horizontal_stroke();
  line.gate = StrokeGate::same_class;
  line.source = static_cast<std::uint32_t>(g.depth_m.index(10, 20));
  const auto canvas = paint({line}, g);
  EXPECT_FLOAT_EQ(canvas(25, 20).x, 1.F);
  EXPECT_FLOAT_EQ(canvas(35, 20).x, 0.F);
}

// A river of a map is often no wider than a stroke of its bank: it must not be painted over.
TEST(Brush, BanksKeepOffWaterThatAMapKnows) {
  const GuidanceBuffers g = border_guidance();
  Stroke grass = horizontal_stroke();
  grass.source = static_cast<std::uint32_t>(g.depth_m.index(10, 20));
  Stroke wave = grass;
  wave.source = static_cast<std::uint32_t>(g.depth_m.index(45, 20));
  const auto painted = [&](const Stroke& stroke, bool known) {
    Painting painting = begin_painting(Grid<glm::vec3>(g.width(), g.height(), glm::vec3(0.F)));
    SheetWindow window;
    window.waters_known = known;
    paint_in_order(painting, g, {stroke}, 1.0, silent_progress(), window);
    return painting.picture;
  };
  EXPECT_FLOAT_EQ(painted(grass, false)(45, 20).x, 1.F);
  EXPECT_LT(painted(grass, true)(45, 20).x, 0.2F) << "the river";
  EXPECT_FLOAT_EQ(painted(grass, true)(45, 19).x, 1.F) << "its bank";
  EXPECT_FLOAT_EQ(painted(wave, true)(45, 20).x, 1.F) << "its own paint";
}

TEST(Brush, ToneGateFadesWithTheDifferenceOfTone) {
  GuidanceBuffers g = flat_guidance();
  for (const auto [x, y] : test::cells({30, 0, g.width(), g.height()})) g.tone(x, y) = 0.5F + 0.16F;
  Stroke s = horizontal_stroke();
  s.tone = 0.5F;
  const auto canvas = paint({s}, g);
  EXPECT_FLOAT_EQ(canvas(20, 20).x, 1.F);
  EXPECT_NEAR(canvas(40, 20).x, std::exp(-1.0), 0.03);
  // Flat on top, so that paint ends at a shadow with an edge: exp(-x⁴), not exp(-x²).
  for (const auto [x, y] : test::cells({30, 0, g.width(), g.height()})) g.tone(x, y) = 0.5F - 0.08F;
  EXPECT_NEAR(paint({s}, g)(40, 20).x, std::exp(-0.0625), 0.01);
}

TEST(Brush, SquareStrokesEndAtTheirPoints) {
  Stroke wall = horizontal_stroke();
  wall.tip = StrokeTip::square;
  const auto canvas = paint({wall}, flat_guidance());
  EXPECT_NEAR(painted_area(canvas), 40.0 * 4.0, 0.5);
  EXPECT_FLOAT_EQ(canvas(10, 18).x, 1.F) << "the corner is full";
  EXPECT_FLOAT_EQ(canvas(9, 20).x, 0.F);
}

// Mean canvas over strokes of many seeds, all at one position: 40 × 6 units from x = 10, at y = 20,
// paint 1 on 0.
Grid<float> mean_of_hairs(const Stroke& like, float pixels_per_unit = 1.F, int seeds = 60) {
  const auto size = [&](int units) {
    return static_cast<int>(static_cast<float>(units) * pixels_per_unit);
  };
  const GuidanceBuffers g = flat_guidance(size(60), size(40));
  Grid<float> mean(g.width(), g.height(), 0.F);
  for (int k = 1; k <= seeds; ++k) {
    Stroke s = like;
    s.tip = StrokeTip::hairs;
    s.start_width = s.end_width = 6.F * pixels_per_unit;
    s.points = {glm::vec2(10.F, 20.F) * pixels_per_unit, glm::vec2(50.F, 20.F) * pixels_per_unit};
    s.seed = static_cast<std::uint32_t>(k) * 2654435761U;
    Painting painting = begin_painting(Grid<glm::vec3>(g.width(), g.height(), glm::vec3(0.F)));
    paint_in_order(painting, g, {s}, static_cast<double>(pixels_per_unit), silent_progress());
    for (std::size_t i = 0; i < mean.size(); ++i)
      mean[i] += painting.picture[i].x / static_cast<float>(seeds);
  }
  return mean;
}

double sum_of(const Grid<float>& grid) {
  double sum = 0.0;
  for (const float v : grid) sum += v;
  return sum;
}

Stroke brush_stroke() {
  Stroke s = horizontal_stroke();
  s.alpha = 0.6F;
  s.bristle = 0.5F;
  s.edge = 0.8F;
  return s;
}

TEST(Brush, HairsLayAsMuchPaintAtAnySize) {
  for (const float bristle : {0.F, 0.5F, 1.F}) {
    Stroke s = brush_stroke();
    s.bristle = bristle;
    const double small = sum_of(mean_of_hairs(s));
    EXPECT_NEAR(sum_of(mean_of_hairs(s, 6.F)) / 36.0, small, 0.08 * small) << bristle;
  }
  // And as much as requested: the dry end and the thin side lose about a quarter.
  for (const float alpha : {0.3F, 0.6F, 0.9F}) {
    Stroke s = brush_stroke();
    s.alpha = alpha;
    EXPECT_NEAR(sum_of(mean_of_hairs(s, 3.F, 30)) / 9.0,
                0.75 * static_cast<double>(alpha) * 40.0 * 6.0,
                0.2 * static_cast<double>(alpha) * 40.0 * 6.0)
        << alpha;
  }
}

// One stroke of 40 × 6 units at six pixels per unit, from x = 60, along y = 120.
Grid<glm::vec3> large_stroke(Stroke s) {
  s.tip = StrokeTip::hairs;
  s.start_width = s.end_width = 36.F;
  s.points = {glm::vec2(60.F, 120.F), glm::vec2(300.F, 120.F)};
  s.seed = 77;
  Painting painting = begin_painting(Grid<glm::vec3>(360, 240, glm::vec3(0.F)));
  paint_in_order(painting, flat_guidance(360, 240), {s}, 6.0, silent_progress());
  return painting.picture;
}

TEST(Brush, EndsWhereItsHairsEnd) {
  Stroke s = brush_stroke();
  s.bristle = 0.F;  // uniform coverage: only the ends of the hairs vary
  const auto canvas = large_stroke(s);
  double sum = 0.0;
  double squares = 0.0;
  for (int y = 112; y < 128; ++y) {  // the centre, where the curve of the end is flat
    int last = 0;
    for (int x = 300; x < 340; ++x)
      if (canvas(x, y).x > 0.02F) last = x - 300;
    sum += last;
    squares += static_cast<double>(last) * last;
  }
  EXPECT_GT(squares / 16.0 - sum * sum / 256.0, 2.0);
}

TEST(Brush, PaintGathersInARidge) {
  Stroke s = brush_stroke();
  s.alpha = s.load = s.edge = 1.F;
  s.bristle = s.wetness = 0.F;
  s.colour = glm::vec3(0.5F);
  const auto canvas = large_stroke(s);
  // At .7 of the half width on its right the ridge differs by ± .05 from the centre, whatever the
  // load.
  EXPECT_NEAR(std::abs(canvas(150, 132).x - canvas(150, 120).x) / 0.97F, 0.05F, 0.01F);
}

TEST(Brush, PaintEndsWithAnEdgeOnOneSide) {
  Stroke s = brush_stroke();
  const Grid<float> right = mean_of_hairs(s);
  s.edge = -s.edge;
  const Grid<float> left = mean_of_hairs(s);
  // y increases to the right of a stroke that runs to the right.
  EXPECT_GT(right(26, 22), 1.25F * right(26, 17));
  EXPECT_GT(left(26, 17), 1.25F * left(26, 22));
}

TEST(Brush, IsSetDownAndRunsDry) {
  const Grid<float> mean = mean_of_hairs(brush_stroke());
  const auto column = [&](int x) {
    float sum = 0.F;
    for (int y = 0; y < mean.height(); ++y) sum += mean(x, y);
    return sum;
  };
  EXPECT_LT(column(11), 0.85F * column(22));
  EXPECT_LT(column(47), 0.7F * column(25));
}

TEST(Brush, HairsDrawStreaksAlongTheStroke) {
  const auto canvas = large_stroke(brush_stroke());
  double along = 0.0;
  double across = 0.0;
  for (const auto [x, y] : test::cells({120, 106, 180, 134})) {
    along += std::abs(canvas(x + 1, y).x - canvas(x, y).x);
    across += std::abs(canvas(x, y + 1).x - canvas(x, y).x);
  }
  EXPECT_GT(across, 10.0 * along);
  EXPECT_GT(across / (28.0 * 60.0), 0.02);  // and they are visible
}

TEST(Brush, LoadsOfPaintDifferAroundTheColourAskedFor) {
  const GuidanceBuffers g = flat_guidance();
  const auto centre = [&](float load, std::uint32_t seed) {
    Stroke s = horizontal_stroke();
    s.tip = StrokeTip::hairs;
    s.alpha = 1.F;
    s.load = load;
    s.seed = seed;
    s.colour = glm::vec3(0.5F);
    return paint({s}, g)(25, 20) / 0.97F;  // max coverage by hairs
  };
  EXPECT_NEAR(centre(0.F, 5).x, 0.5F, 0.003F);
  EXPECT_NEAR(centre(0.F, 5).x, centre(0.F, 6).x, 1e-6F);
  double sum = 0.0;
  double squares = 0.0;
  double warmth = 0.0;
  for (std::uint32_t k = 1; k <= 400; ++k) {
    const glm::vec3 c = centre(1.F, k);
    sum += c.y;
    squares += (c.y - 0.5) * (c.y - 0.5);
    warmth += (c.x - c.z) * (c.x - c.z);
  }
  EXPECT_NEAR(sum / 400.0, 0.5, 0.004);
  EXPECT_GT(std::sqrt(squares / 400.0), 0.015);
  EXPECT_GT(std::sqrt(warmth / 400.0), 0.02);
}

TEST(Brush, LargerOrderIsPaintedFirst) {
  Stroke white = horizontal_stroke();
  Stroke black = horizontal_stroke();
  black.colour = glm::vec3(0.F);
  white.order = 1.F;
  black.order = 2.F;
  EXPECT_FLOAT_EQ(paint({white, black}, flat_guidance())(30, 20).x, 1.F);
  white.order = 3.F;
  EXPECT_FLOAT_EQ(paint({white, black}, flat_guidance())(30, 20).x, 0.F);
}

TEST(Brush, ThreadsChangeNoBit) {
  const GuidanceBuffers g = flat_guidance(500, 400);
  std::vector<Stroke> strokes;
  for (int i = 0; i < 300; ++i) {
    Stroke s = horizontal_stroke();
    for (auto& p : s.points)
      p += glm::vec2(static_cast<float>((i * 37) % 450), static_cast<float>((i * 53) % 380));
    s.tip = i % 2 == 0 ? StrokeTip::hairs : StrokeTip::round;
    s.bristle = s.edge = s.load = 0.5F;
    s.alpha = 0.6F;
    s.colour = glm::vec3(static_cast<float>(i % 7) / 7.F);
    s.order = static_cast<float>(i % 5);
    s.seed = static_cast<std::uint32_t>(i);
    strokes.push_back(s);
  }
  const auto many = paint(strokes, g);
  const ThreadLimit one(1);
  EXPECT_EQ(paint(strokes, g), many);
}

// A stroke that comes from brighter ground of its class does not glare on darker ground; over
// another class, and as what stands on the ground, it keeps its colour.
TEST(Brush, PaintStaysNearTheGroundOfItsClass) {
  const auto painted = [](PaintPart part, bool other_class, bool held) {
    GuidanceBuffers g = flat_guidance(60, 40);
    Stroke stroke{.points = {glm::vec2(10.F, 20.F), glm::vec2(50.F, 20.F)}, .point_count = 2};
    stroke.start_width = stroke.end_width = 10.F;
    stroke.colour = glm::vec3(0.7F, 0.4F, 0.3F);
    stroke.depth_m = g.depth_m(30, 20);
    stroke.part = part;
    stroke.source = static_cast<std::uint32_t>(g.depth_m.index(12, 20));
    if (other_class) g.land_cover(30, 20) = LandCoverClass::scree;
    const Grid<glm::vec3> ground(60, 40, glm::vec3(0.3F));
    Painting painting = begin_painting(ground, false);
    SheetWindow window;
    window.ground = held ? &ground : nullptr;
    paint_in_order(painting, g, {stroke}, 1.0, silent_progress(), window);
    EXPECT_TRUE(painting.sources.empty()) << "nothing is recorded";
    return painting.picture(30, 20);
  };
  const auto expect_near = [](const glm::vec3& a, const glm::vec3& b) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 0.002F);
  };
  expect_near(painted(PaintPart::ground, false, false), {0.7F, 0.4F, 0.3F});
  expect_near(painted(PaintPart::ground, false, true), {0.37F, 0.3175F, 0.3F});
  expect_near(painted(PaintPart::ground, true, true), {0.7F, 0.4F, 0.3F});
  expect_near(painted(PaintPart::trees, false, true), {0.7F, 0.4F, 0.3F});
}

}  // namespace
}  // namespace belvedere
