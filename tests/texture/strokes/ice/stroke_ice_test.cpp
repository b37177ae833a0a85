#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/random.h"
#include "tests/grids.h"
#include "tests/texture/strokes/stroke_picture.h"
#include "texture/strokes/ice/ice_ground.h"
#include "texture/strokes/stroke_painter.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// One class over the whole picture, depth increasing upwards from 20 to 22 km, ice flowing straight
// down, tone .6.
Picture one_class(LandCoverClass id, float slope_deg, int width = 320, int height = 240) {
  Picture p = plain_picture(id, width, height);
  p.guidance.slope_deg = Grid<float>(width, height, slope_deg);
  for (const auto [x, y] : test::cells(width, height)) {
    p.guidance.depth_m(x, y) =
        22000.F - 2000.F * static_cast<float>(y) / static_cast<float>(height);
    p.guidance.position_m(x, y) =
        glm::vec3(20.F * static_cast<float>(x), p.guidance.depth_m(x, y), 2900.F);
  }
  p.ground.tree_density = Grid<float>(width, height, 0.F);
  return p;
}

void set_flow(Picture& p, glm::vec2 flow) {
  for (auto& d : p.guidance.fall_line) d = flow;
}

void set_class(Picture& p, int x0, int y0, int x1, int y1, LandCoverClass id) {
  for (const auto [x, y] : test::cells({x0, y0, x1, y1})) p.guidance.land_cover(x, y) = id;
}

// Fall lines that turn by up to ±60° from pixel to pixel: ice over them keeps its direction within
// a few degrees.
TEST(IceFlow, FollowsTheBroadFallOfItsBed) {
  Picture p = one_class(glacier, 12.F);
  for (const auto [x, y] : test::cells(320, 240)) {
    const double turn = 2.1 * (random_uniform(5, x, y) - 0.5);
    p.guidance.fall_line(x, y) = glm::vec2(std::sin(0.5 + turn), std::cos(0.5 + turn));
  }
  const StrokeScene scene = p.scene();
  const IceFlow flow = find_ice_flow(scene);
  const glm::vec2 mean(std::sin(0.5F), std::cos(0.5F));
  for (const auto [x, y] : test::cells({20, 20, 300, 220}, 10)) {
    const glm::vec2 at = flow.at({static_cast<float>(x), static_cast<float>(y)});
    EXPECT_NEAR(glm::length(at), 1.F, 1e-5F);
    EXPECT_LT(angle_deg(at, mean), 6.0) << x << ", " << y;
  }
  for (const Stroke& s : grow_strokes("snow", scene)) {
    if (std::abs(s.points[1].x - 160.F) > 90.F || std::abs(s.points[1].y - 120.F) > 60.F) continue;
    EXPECT_LT(angle_deg(axis_of(s), mean), 14.0);
  }
}

// Round a bend of the valley, strokes bend with it, and a trace stays on its circle.
TEST(IceFlow, TurnsWithTheValley) {
  Picture p = one_class(glacier, 12.F);
  for (const auto [x, y] : test::cells(320, 240))
    p.guidance.fall_line(x, y) =
        glm::normalize(glm::vec2(static_cast<float>(y) + 20.F, -static_cast<float>(x) - 0.5F));
  const StrokeScene scene = p.scene();
  const IceFlow flow = find_ice_flow(scene);
  const auto way = trace_ice(scene, flow, {100.F, 200.F}, 5.F, 40);
  ASSERT_GT(way.size(), 30U);
  for (const glm::vec2 at : way)
    EXPECT_NEAR(glm::length(at + glm::vec2(0.F, 20.F)), glm::length(glm::vec2(100.F, 220.F)), 3.F);
  // Reversed: it ends where the class does.
  set_class(p, 150, 0, 320, 240, rock);
  for (const glm::vec2 at : trace_ice(scene, flow, {100.F, 200.F}, 5.F, 40)) EXPECT_LT(at.x, 151.F);
}

TEST(Ice, SnowIsLaidInLongStrokes) {
  const Picture p = one_class(snow, 20.F);
  double sum = 0.0;
  int count = 0;
  for (const Stroke& s : grow_strokes("snow", p.scene())) {
    sum += glm::length(axis_of(s));
    ++count;
  }
  EXPECT_GT(sum / count, 19.0);  // units of 0.5 mm
}

TEST(Ice, CrevassesLieAcrossTheFlowAndOnlyWhereIceIsTorn) {
  Picture p = one_class(glacier, 24.F);
  const glm::vec2 flow(0.6F, 0.8F);
  set_flow(p, flow);
  for (const auto [x, y] : test::cells(320, 240))
    p.guidance.position_m(x, y).y = -20.F * static_cast<float>(y);  // seen from above
  const auto torn = grow_strokes("glacier crevasses", p.scene());
  EXPECT_GT(torn.size(), 100U);
  for (const Stroke& s : torn)
    if (s.tip == StrokeTip::round) {
      EXPECT_GE(angle_deg(axis_of(s), flow), 50.0);
    }
  for (float& slope : p.guidance.slope_deg) slope = 3.F;
  EXPECT_TRUE(grow_strokes("glacier crevasses", p.scene()).empty());
}

// They come in fields, with intact ice between: counts over squares vary far more than for evenly
// spread ones.
TEST(Ice, CrevassesComeInFields) {
  const Picture p = one_class(glacier, 16.F, 900, 600);
  constexpr int cell = 60;
  Grid<int> counts(900 / cell, 600 / cell, 0);
  for (const Stroke& s : grow_strokes("glacier crevasses", p.scene()))
    if (s.points[0].x > 0.F && s.points[0].x < 900.F && s.points[0].y > 0.F &&
        s.points[0].y < 600.F)
      ++counts(static_cast<int>(s.points[0].x) / cell, static_cast<int>(s.points[0].y) / cell);
  int empty = 0;
  int full = 0;
  for (const int n : counts) {
    empty += n == 0 ? 1 : 0;
    full += n >= 12 ? 1 : 0;
  }
  EXPECT_GT(empty, static_cast<int>(counts.size()) / 5);
  EXPECT_GT(full, static_cast<int>(counts.size()) / 12);
}

TEST(Ice, CopiedIceGetsItsCrevassesToo) {
  Picture p = one_class(glacier, 22.F);
  const StrokeLayers over_copied{
      .sky = true, .ground = false, .accents = true, .breaks = true, .upright = true};
  const StrokeLayers copied_from{
      .sky = true, .ground = false, .accents = true, .breaks = false, .upright = true};
  const auto painted_at = [&](float slope_deg, const StrokeLayers& layers) {
    p.guidance.slope_deg = Grid<float>(320, 240, slope_deg);
    return paint_strokes(p.ground.colour, p.guidance, p.ground, layers, {}, silent_progress())
        .picture;
  };
  // Level ice has none, so with all other strokes over copied ground, the two differ by crevasses.
  EXPECT_NE(painted_at(24.F, over_copied), painted_at(3.F, over_copied));
  EXPECT_EQ(painted_at(24.F, copied_from), painted_at(3.F, copied_from))
      << "what is copied from has none";
}

TEST(Ice, FlowLinesAreLongAndFollowTheIce) {
  Picture p = one_class(glacier, 12.F);
  const glm::vec2 flow(0.6F, 0.8F);
  set_flow(p, flow);
  const auto lines = grow_strokes("glacier flow lines", p.scene());
  ASSERT_GT(lines.size(), 100U);
  for (const Stroke& s : lines) {
    EXPECT_GT(glm::length(axis_of(s)), 20.F);
    EXPECT_LT(angle_deg(axis_of(s), flow), 20.0);
  }
}

// A rib of rock 16 units wide that ends in the centre of the ice: a band of rubble runs down from
// its end and from nowhere else, wider the farther down, to where the ice ends.
TEST(Ice, MedialMorainesBeginBelowRibs) {
  Picture p = one_class(glacier, 10.F, 320, 400);
  EXPECT_TRUE(grow_strokes("glacier moraines", p.scene()).empty());
  set_class(p, 152, 0, 168, 120, rock);
  const auto lines = grow_strokes("glacier moraines", p.scene());
  ASSERT_GT(lines.size(), 100U);
  float lowest = 0.F;
  float widest_above = 0.F;
  float widest_below = 0.F;
  double lumas = 0.0;
  for (const Stroke& s : lines) {
    for (int k = 0; k < s.point_count; ++k) {
      const glm::vec2 at = s.points[static_cast<std::size_t>(k)];
      EXPECT_GT(at.y, 116.F);
      lowest = std::max(lowest, at.y);
      (at.y < 170.F ? widest_above : widest_below) =
          std::max(at.y < 170.F ? widest_above : widest_below, std::abs(at.x - 160.F));
    }
    lumas += static_cast<double>(luma(s.colour));
  }
  EXPECT_LT(lumas / static_cast<double>(lines.size()), 0.62) << "rubble, not ice";
  EXPECT_GT(lowest, 360.F) << "to the end of the ice";
  EXPECT_LT(widest_above, 12.F);
  EXPECT_GT(widest_below, widest_above + 1.F);
}

// None begins at the margin, and none ends in firn.
TEST(Ice, NoMorainesAtMarginsOrInFirn) {
  Picture p = one_class(glacier, 10.F, 320, 400);
  set_class(p, 0, 0, 120, 400, rock);
  EXPECT_TRUE(grow_strokes("glacier moraines", p.scene()).empty());
  Picture firn = one_class(glacier, 10.F, 320, 400);
  set_class(firn, 152, 0, 168, 120, rock);
  set_class(firn, 0, 260, 320, 400, snow);
  EXPECT_TRUE(grow_strokes("glacier moraines", firn.scene()).empty());
}

// Where a steep bed tears the ice most, it breaks into blocks: more strokes, some of them square.
TEST(Ice, IcefallsBreakIntoBlocks) {
  const auto blocks = [](float slope_deg) {
    Picture p = one_class(glacier, slope_deg, 320, 400);
    p.guidance.relief_s_m = Grid<float>(320, 400, 12.F);
    int square = 0;
    over_seeds(p, [&] {
      for (const Stroke& s : grow_strokes("glacier crevasses", p.scene()))
        square += s.tip == StrokeTip::square ? 1 : 0;
    });
    return square;
  };
  EXPECT_GT(blocks(27.F), 30);
  EXPECT_EQ(blocks(15.F), 0);
}

// Crevasses across ice that flows across the picture are foreshortened.
TEST(Ice, CrevassesAreForeshortenedWhereIceFlowsAcrossThePicture) {
  const auto length = [](glm::vec2 flow) {
    Picture p = one_class(glacier, 20.F, 400, 400);
    // Ground seen at an angle: a unit down the picture is four times as long as one across.
    for (const auto [x, y] : test::cells(400, 400)) {
      p.guidance.position_m(x, y) =
          glm::vec3(10.F * static_cast<float>(x), -40.F * static_cast<float>(y), 2900.F);
      p.guidance.footprint_m(x, y) = 10.F;
      p.guidance.relief_s_m(x, y) = 15.F;
    }
    set_flow(p, flow);
    double sum = 0.0;
    int count = 0;
    over_seeds(p, [&] {
      for (const Stroke& s : grow_strokes("glacier crevasses", p.scene())) {
        if (s.tip != StrokeTip::round) continue;
        sum += static_cast<double>(glm::length(axis_of(s)));
        ++count;
      }
    });
    EXPECT_GT(count, 20);
    return sum / count;
  };
  EXPECT_LT(length({1.F, 0.F}), 0.5 * length({0.F, 1.F}));
}

TEST(Ice, GlaciersAreLinedWithRubbleWhereTheyEndOnGroundNotOnSnow) {
  const auto edges = [](LandCoverClass beyond) {
    Picture p = one_class(glacier, 12.F);
    set_class(p, 160, 0, 320, 240, beyond);
    return grow_strokes("glacier edges", p.scene());
  };
  EXPECT_TRUE(edges(snow).empty());
  const auto strokes = edges(scree);
  EXPECT_GT(strokes.size(), 50U);
  for (const Stroke& s : strokes) EXPECT_NEAR(s.points[1].x, 160.F, 14.F);
}

// Where it ends down its flow: a blue wall across, dirty ice above it, rubble below.
TEST(Ice, TonguesEndBlueAndDirty) {
  Picture p = one_class(glacier, 12.F);
  set_class(p, 0, 150, 320, 240, scree);
  int walls = 0, dirt = 0, rubble = 0;
  for (const Stroke& s : grow_strokes("glacier edges", p.scene())) {
    EXPECT_GT(s.points[1].y, 150.F - 32.F) << "only at the tongue";
    const bool across = angle_deg(axis_of(s), {1.F, 0.F}) < 30.0;
    const bool blue = s.colour.b > s.colour.r + 0.05F;
    if (blue) {
      ++walls;
      EXPECT_TRUE(across);
      EXPECT_EQ(s.gate, StrokeGate::same_class);
    } else if (across) {
      ++rubble;
      EXPECT_GT(s.points[1].y, 148.F);
    } else {
      ++dirt;
    }
  }
  EXPECT_GT(walls, 40);
  EXPECT_GT(dirt, 40);
  EXPECT_GT(rubble, 20);
}

TEST(Ice, GrowsWithTheSheet) {
  // Twice the pixels for the same paper: as many strokes, twice as long.
  const Picture small = one_class(glacier, 14.F, 320, 240);
  const Picture large = one_class(glacier, 14.F, 640, 480);
  StrokeParameters at_two;
  at_two.pixels_per_unit = 2.0;
  const auto length = [](const std::vector<Stroke>& strokes) {
    double sum = 0.0;
    for (const Stroke& s : strokes) sum += glm::length(axis_of(s));
    return sum / static_cast<double>(strokes.size());
  };
  for (const std::string_view name : {"snow", "glacier flow lines", "glacier crevasses"}) {
    const auto one = grow_strokes(name, {small.guidance, small.ground, {}});
    const auto two = grow_strokes(name, {large.guidance, large.ground, at_two});
    ASSERT_FALSE(one.empty());
    EXPECT_NEAR(static_cast<double>(two.size()) / static_cast<double>(one.size()), 1.0, 0.15);
    EXPECT_NEAR(length(two) / length(one), 2.0, 0.2);
  }
}

}  // namespace
}  // namespace belvedere
