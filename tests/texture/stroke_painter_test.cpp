#include "texture/stroke_painter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "renderer/base/error.h"
#include "renderer/base/parallel.h"
#include "texture/stroke_kinds.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

struct Picture {
  GuidanceBuffers guidance;
  PaintGround ground;
};

// One class over the whole picture, depth growing upwards from 20 to 60 km, fall line straight down, tone .6.
Picture one_class(LandCoverClass id, int width = 320, int height = 240) {
  Picture p;
  p.guidance.depth_m = Grid<float>(width, height);
  p.guidance.land_cover = Grid<LandCoverClass>(width, height, id);
  p.guidance.fall_line = Grid<glm::vec2>(width, height, glm::vec2(0.F, 1.F));
  p.guidance.tone = Grid<float>(width, height, 0.6F);
  p.guidance.position_m = Grid<glm::vec3>(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      p.guidance.depth_m(x, y) =
          id == sky ? std::numeric_limits<float>::infinity() : 60000.F - 40000.F * static_cast<float>(y) / static_cast<float>(height);
      p.guidance.position_m(x, y) = glm::vec3(20.F * static_cast<float>(x), p.guidance.depth_m(x, y), 900.F);
    }
  p.ground.colour = Grid<glm::vec3>(width, height, glm::vec3(0.5F));
  p.ground.darker = Grid<glm::vec3>(width, height, glm::vec3(0.4F));
  p.ground.lighter = Grid<glm::vec3>(width, height, glm::vec3(0.6F));
  p.ground.accent = Grid<float>(width, height, 0.F);
  p.ground.tree_density = Grid<float>(width, height, 0.95F);
  p.ground.haze = Grid<float>(width, height, 0.F);
  return p;
}

double mean_height(const std::vector<Stroke>& strokes, float y0, float y1) {
  double sum = 0.0;
  int count = 0;
  for (const Stroke& s : strokes) {
    if (s.gate != StrokeGate::upright || s.points[0].y < y0 || s.points[0].y >= y1) continue;
    sum += s.points[0].y - s.points[1].y;
    ++count;
  }
  return sum / count;
}

TEST(StrokePainter, TreesStandUprightWhateverTheSlope) {
  Picture p = one_class(forest);
  for (auto& d : p.guidance.fall_line) d = glm::vec2(0.8F, 0.6F);  // a slope that falls to the right
  const StrokeParameters parameters;
  const auto trees = forest_trees({p.guidance, p.ground, parameters});
  int bodies = 0;
  for (const Stroke& s : trees) {
    if (s.gate != StrokeGate::upright) continue;
    const glm::vec2 axis = s.points[1] - s.points[0];
    EXPECT_LT(axis.y, 0.F);
    EXPECT_LT(std::abs(axis.x), std::tan(0.1745F) * std::abs(axis.y) + 0.2F);  // within 10°
    ++bodies;
  }
  EXPECT_GT(bodies, 500);
}

TEST(StrokePainter, TreesAreAsTallFarAsNear) {
  const Picture p = one_class(forest);
  const StrokeParameters parameters;
  const auto trees = forest_trees({p.guidance, p.ground, parameters});
  EXPECT_NEAR(mean_height(trees, 0.F, 80.F) / mean_height(trees, 160.F, 240.F), 1.0, 0.05);
}

TEST(StrokePainter, StrokesGrowWithTheSheet) {
  const Picture small = one_class(forest, 200, 200);
  const Picture large = one_class(forest, 400, 400);
  const StrokeParameters at_one;
  StrokeParameters at_two;
  at_two.pixels_per_unit = 2.0;
  const auto a = forest_trees({small.guidance, small.ground, at_one});
  const auto b = forest_trees({large.guidance, large.ground, at_two});
  EXPECT_NEAR(mean_height(b, 0.F, 400.F) / mean_height(a, 0.F, 200.F), 2.0, 0.05);
  EXPECT_NEAR(static_cast<double>(b.size()) / static_cast<double>(a.size()), 1.0, 0.1);
}

TEST(StrokePainter, LightSideFollowsTheSun) {
  const Picture p = one_class(forest);
  StrokeParameters from_left;
  from_left.sun_side = -1.0;
  const StrokeParameters from_right;
  const auto offset = [&](const StrokeParameters& parameters) {
    // The lit stroke stands right behind its dark body in the list.
    const auto trees = forest_trees({p.guidance, p.ground, parameters});
    double sum = 0.0;
    for (std::size_t i = 1; i < trees.size(); ++i)
      if (trees[i].gate == StrokeGate::upright && trees[i - 1].gate == StrokeGate::upright &&
          trees[i].start_width < 0.6F * trees[i - 1].start_width)
        sum += trees[i].points[0].x - trees[i - 1].points[0].x;
    return sum;
  };
  EXPECT_GT(offset(from_right), 0.0);
  EXPECT_LT(offset(from_left), 0.0);
}

TEST(StrokePainter, EachClassGrowsItsOwnStrokesOnly) {
  const StrokeParameters parameters;
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    const Picture p = one_class(info.id);
    const StrokeScene scene{p.guidance, p.ground, parameters};
    EXPECT_EQ(forest_trees(scene).empty(), info.id != forest) << info.name;
    EXPECT_EQ(rock_facets(scene).empty(), info.id != rock) << info.name;
    EXPECT_EQ(water_strokes(scene).empty(), info.id != water) << info.name;
    EXPECT_EQ(houses(scene).empty(), info.id != settlement) << info.name;
    EXPECT_EQ(sky_strokes(scene).empty(), info.id != sky) << info.name;
    EXPECT_EQ(snow_strokes(scene).empty(), info.id != snow && info.id != glacier) << info.name;
  }
}

TEST(StrokePainter, RockIsHatchedAlongTheFallLine) {
  Picture p = one_class(rock);
  const glm::vec2 down = glm::vec2(0.6F, 0.8F);
  for (auto& d : p.guidance.fall_line) d = down;
  const StrokeParameters parameters;
  int along = 0;
  int all = 0;
  for (const Stroke& s : rock_hatching({p.guidance, p.ground, parameters})) {
    const glm::vec2 axis = s.points[3] - s.points[0];
    const float cosine = std::abs(axis.x * down.x + axis.y * down.y) / std::hypot(axis.x, axis.y);
    along += cosine > std::cos(0.6F) ? 1 : 0;
    ++all;
  }
  EXPECT_GT(along, all * 3 / 4);  // one in eight is a ledge across
}

TEST(StrokePainter, UprightLayerAloneLeavesBareGroundUntouched) {
  const Picture p = one_class(rock);
  const Grid<glm::vec3> canvas(320, 240, glm::vec3(0.3F));
  const StrokeLayers upright_only{.sky = false, .ground = false, .accents = false, .upright = true};
  EXPECT_EQ(paint_strokes(canvas, p.guidance, p.ground, upright_only, {}, silent_progress()).picture, canvas);
}

TEST(StrokePainter, MeanColourStaysNearTheBase) {
  const Picture p = one_class(pasture);
  const auto picture = paint_strokes(p.ground.colour, p.guidance, p.ground, {.upright = false}, {}, silent_progress()).picture;
  double sum = 0.0;
  double squares = 0.0;
  for (const glm::vec3& c : picture) {
    sum += c.y;
    squares += c.y * c.y;
  }
  const double mean = sum / static_cast<double>(picture.size());
  EXPECT_NEAR(mean, 0.5, 0.02);
  EXPECT_GT(squares / static_cast<double>(picture.size()) - mean * mean, 1e-4);  // and it is painted, not flat
}

TEST(StrokePainter, ThreadsChangeNoBit) {
  const Picture p = one_class(forest);
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return paint_strokes(p.ground.colour, p.guidance, p.ground, {}, {}, silent_progress()).picture;
  };
  EXPECT_EQ(run(1), run(2));
}

TEST(StrokePainter, RefusesGridsOfDifferentSize) {
  const Picture p = one_class(forest);
  const Grid<glm::vec3> canvas(10, 10);
  EXPECT_THROW(paint_strokes(canvas, p.guidance, p.ground, {}, {}, silent_progress()), Error);
}

}  // namespace
}  // namespace belvedere
