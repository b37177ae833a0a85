#include "renderer/stages/ground_inputs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/grid.h"
#include "renderer/stages/lit_picture.h"
#include "renderer/stages/stages.h"
#include "tests/grids.h"
#include "tests/scenes.h"
#include "tests/texture/statistical/texture_crops.h"
#include "texture/statistical/learn_texture.h"

namespace belvedere {
namespace {

// Before there is a world the stages have the same reaches as afterwards, so that memory is known
// beforehand.
TEST(GroundInputs, AnEstimateHasTheReachesOfTheWorlds) {
  const LoadedScene scene =
      test::small_scene({"output.width=400", "output.height=200", "land_cover.rock=granite"});
  const World world = make_world(scene, silent_progress());
  const Palette palette = read_palette("summer");
  TileStore::Place nowhere;
  StageGraph made(nowhere, silent_progress());
  StageGraph estimated(nowhere, silent_progress());
  const auto add = [](StageGraph& graph, GroundInputs inputs) {
    const GroundStages ground = add_ground_stages(graph, std::move(inputs), 256);
    return add_picture_stages(graph, ground, nullptr).picture->bytes_to_make(256);
  };
  const double bytes = add(made, make_ground_inputs(world, view_of(world), palette, {}));
  EXPECT_EQ(add(estimated, estimate_ground_inputs(scene.scene, scene.scene.pixels_per_unit())),
            bytes);
  EXPECT_GT(bytes, 400.0 * 200.0 * 60.0);
  EXPECT_EQ(estimated.draw(4.0), made.draw(4.0));
}

using enum LandCoverClass;

constexpr float infinity = std::numeric_limits<float>::infinity();

const GroundModels& meadow_models() {
  static const GroundModels models = [] {
    LearnParameters few;
    few.types = 20;
    GroundModel of;
    of.model = learn_texture(test::meadow_crop(96, 96), {}, few).model;
    of.model.seed = TextureSeed::streaks;
    of.model.seed_px = 8.F;
    of.model.polish = false;
    of.record = record_texture(of.model, {.seed = of.seed});
    GroundModels out;
    out.models.push_back(std::move(of));
    for (GroundModels::OfClass* of_class : {&out.lit, &out.shaded})
      for (const LandCoverClass id : {pasture, water})
        (*of_class)[static_cast<std::size_t>(id)] = 0;
    return out;
  }();
  return models;
}

GuidanceBuffers flat_guidance(int width, int height, LandCoverClass id, glm::vec2 down) {
  GuidanceBuffers guidance;
  guidance.depth_m = Grid<float>(width, height, 1000.F);
  guidance.land_cover = Grid<LandCoverClass>(width, height, id);
  guidance.fall_line = Grid<glm::vec2>(width, height, down);
  return guidance;
}

// The paint of a square of one class on a slope.
ModelPaint painted(LandCoverClass id, glm::vec2 down, int side = 160) {
  const PixelRect tile{0, 0, side, side};
  return make_model_paint(meadow_models(), tile, Grid<LandCoverClass>(side, side, id),
                          flat_guidance(side, side, id, down), tile);
}

// Direction of strokes, degrees clockwise from horizontal, 0…180: from the structure tensor of
// lightness.
double stroke_deg(const Grid<glm::vec3>& picture) {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (int y = 1; y + 1 < picture.height(); ++y)
    for (int x = 1; x + 1 < picture.width(); ++x) {
      const double dx = static_cast<double>(picture(x + 1, y).y - picture(x - 1, y).y);
      const double dy = static_cast<double>(picture(x, y + 1).y - picture(x, y - 1).y);
      xx += dx * dx;
      xy += dx * dy;
      yy += dy * dy;
    }
  const double across = .5 * std::atan2(2.0 * xy, xx - yy) * 180.0 / 3.14159265;
  return std::fmod(across + 270.0, 180.0);
}

double between(double a, double b) {
  const double d = std::fmod(std::abs(a - b), 180.0);
  return std::min(d, 180.0 - d);
}

TEST(ModelGround, StrokesRunDownTheFallLineAndLevelOnWater) {
  EXPECT_LT(between(stroke_deg(painted(pasture, {.6F, .8F}).texel), 53.13), 15.0);
  EXPECT_LT(between(stroke_deg(painted(pasture, {-.6F, .8F}).texel), 126.87), 15.0);
  EXPECT_LT(between(stroke_deg(painted(water, {.6F, .8F}).texel), 0.0), 15.0);
  EXPECT_LT(between(stroke_deg(painted(pasture, {0.F, 0.F}).texel), 0.0), 15.0);
}

TEST(ModelGround, OnlyItsClassesArePaintedAndNoSky) {
  constexpr int side = 64;
  GuidanceBuffers guidance = flat_guidance(side, side, pasture, {0.F, 1.F});
  Grid<LandCoverClass> shown(side, side, pasture);
  for (const auto [x, y] : test::cells(side, side)) {
    if (x < 20) shown(x, y) = rock;
    if (y < 12) guidance.depth_m(x, y) = infinity;
  }
  const ModelPaint paint =
      make_model_paint(meadow_models(), {0, 0, side, side}, shown, guidance, {0, 0, side, side});
  for (const auto [x, y] : test::cells(side, side)) {
    const bool expected = x >= 20 && y >= 12;
    ASSERT_EQ(paint.made(x, y), expected ? 1 : 0) << x << " " << y;
    ASSERT_EQ(paint.texel(x, y) != glm::vec3(0.F), expected) << x << " " << y;
  }
}

// In a class with two models bright positions have one and dark positions the other, with a ragged
// border between.
TEST(ModelGround, LightAndShadeHaveModelsOfTheirOwn) {
  constexpr int side = 96;
  GroundModels two = meadow_models();
  two.models.push_back(two.models.front());
  two.models.back().seed = 77;
  two.shaded[static_cast<std::size_t>(pasture)] = 1;
  EXPECT_TRUE(two.by_light());
  Grid<float> tone(side, side);
  for (const auto [x, y] : test::cells(side, side)) tone(x, y) = x < 32 ? .2F : x < 64 ? .55F : .9F;
  const PixelRect tile{0, 0, side, side};
  const Grid<LandCoverClass> shown(side, side, pasture);
  const GuidanceBuffers guidance = flat_guidance(side, side, pasture, {0.F, 1.F});
  const ModelPaint paint = make_model_paint(two, tile, shown, guidance, tile, tone);
  int lit = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < 32; ++x) ASSERT_EQ(paint.made(x, y), 2);
    for (int x = 64; x < side; ++x) ASSERT_EQ(paint.made(x, y), 1);
    for (int x = 32; x < 64; ++x) lit += paint.made(x, y) == 1 ? 1 : 0;
  }
  EXPECT_NEAR(lit, side * 16, side * 6);
  const ModelPaint one = make_model_paint(meadow_models(), tile, shown, guidance, tile);
  EXPECT_EQ(paint.texel(80, 40), one.texel(80, 40));
  EXPECT_NE(part_of(paint.texel, {0, 0, 32, side}), part_of(one.texel, {0, 0, 32, side}));
  EXPECT_THROW(make_model_paint(two, tile, shown, guidance, tile), Error)
      << "light decides, and there is none";
}

// Its own light is what remains when strokes are blurred away: the same mean, and much smoother.
TEST(ModelGround, TheBaseIsThePaintWithoutItsStrokes) {
  const ModelPaint paint = painted(pasture, {0.F, 1.F});
  const auto figures = [](const Grid<glm::vec3>& picture) {
    double mean = 0.0;
    double step = 0.0;
    for (const auto [x, y] : test::cells({1, 0, picture.width(), picture.height()})) {
      mean += static_cast<double>(picture(x, y).y);
      step += std::abs(static_cast<double>(picture(x, y).y - picture(x - 1, y).y));
    }
    return std::pair(mean / static_cast<double>(picture.size()),
                     step / static_cast<double>(picture.size()));
  };
  const auto [texel_mean, texel_step] = figures(paint.texel);
  const auto [base_mean, base_step] = figures(paint.base);
  EXPECT_NEAR(base_mean, texel_mean, .01);
  EXPECT_LT(base_step, texel_step / 4.0);
}

// Tiles side by side, each made from its own box: the result is one texture, to within one level
// where it matters.
TEST(ModelGround, TilesMeetWithoutASeam) {
  constexpr int side = 150;
  const GuidanceBuffers guidance = flat_guidance(2 * side, side, pasture, {.6F, .8F});
  const PixelRect sheet{0, 0, 2 * side, side};
  const auto tile = [&](PixelRect rect) {
    return make_model_paint(meadow_models(), rect,
                            Grid<LandCoverClass>(rect.width(), rect.height(), pasture), guidance,
                            sheet);
  };
  const ModelPaint whole = tile(sheet);
  const ModelPaint right = tile({side, 0, 2 * side, side});
  const ModelPaint cut{
      .made = {}, .texel = part_of(whole.texel, {side, 0, 2 * side, side}), .base = {}};
  double worst = 0.0;
  for (std::size_t i = 0; i < cut.texel.size(); ++i)
    for (int c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(static_cast<double>(cut.texel[i][c] - right.texel[i][c])));
  EXPECT_LE(worst, 2.5 / 255.0);
}

TEST(ModelGround, ItsClassesAreHiddenFromSynthesis) {
  GuideStack guides;
  guides.label = Grid<std::uint8_t>(3, 1);
  guides.label(0, 0) = static_cast<std::uint8_t>(pasture);
  guides.label(1, 0) = static_cast<std::uint8_t>(rock);
  guides.label(2, 0) = unused_label;
  hide_modelled(guides, meadow_models());
  EXPECT_EQ(guides.label(0, 0), unused_label);
  EXPECT_EQ(guides.label(1, 0), static_cast<std::uint8_t>(rock));
  EXPECT_EQ(guides.label(2, 0), unused_label);
  EXPECT_FALSE(GroundModels{}.any());
}

}  // namespace
}  // namespace belvedere
