#include "renderer/exemplar/example_painting.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

#include "tests/scenes.h"

namespace belvedere {
namespace {

class ExamplePaintings : public testing::Test {
 protected:
  ExamplePaintings()
      : world_(make_world(test::small_scene(), silent_progress())),
        palette_(read_palette("summer")) {}
  LitPicture lit() const { return make_lit_picture(world_, palette_, {0, 0, 96, 80}, {}); }
  ExamplePainting paint(const ExampleLayers& layers) const {
    return paint_example(world_, palette_, lit(), layers, silent_progress());
  }

  World world_;
  Palette palette_;
};

TEST_F(ExamplePaintings, EveryPixelKnowsWhosePaintItShows) {
  const ExamplePainting example = paint({});
  const GuidanceBuffers& g = example.guidance;
  int reached_over = 0;
  for (std::size_t i = 0; i < g.painted_from.size(); ++i) {
    ASSERT_EQ(g.painted_class[i], g.land_cover[g.painted_from[i]]);
    reached_over += g.painted_class[i] != g.land_cover[i] ? 1 : 0;
  }
  EXPECT_GT(reached_over, 0) << "strokes overlap the borders of classes";
  EXPECT_FALSE(example.painting == example.ground_layer) << "trees are in the painting only";
  EXPECT_FALSE(g.painted_from == g.ground_from);
  EXPECT_TRUE(g.stroke.same_size(g.depth_m));
}

TEST_F(ExamplePaintings, TheGroundIsTheSameWithoutThePainting) {
  const ExamplePainting ground = paint({.painting = false});
  EXPECT_TRUE(ground.painting.empty());
  EXPECT_TRUE(ground.guidance.painted_class.empty());
  EXPECT_TRUE(ground.guidance.painted_from.empty());
  EXPECT_TRUE(ground.guidance.stroke.empty());
  const ExamplePainting whole = paint({});
  EXPECT_TRUE(ground.ground_layer == whole.ground_layer);
  EXPECT_TRUE(ground.guidance.ground_from == whole.guidance.ground_from);
}

TEST_F(ExamplePaintings, WithoutASkyTheBaseLiesBare) {
  const ExamplePainting example = paint({.painting = false, .sky = false});
  const LitPicture base = lit();
  int sky = 0;
  for (std::size_t i = 0; i < base.base.colour.size(); ++i)
    if (base.guidance.is_sky(i)) {
      ++sky;
      ASSERT_EQ(example.ground_layer[i], base.base.colour[i]);
    }
  EXPECT_GT(sky, 100);
}

TEST_F(ExamplePaintings, ClassAndColourOfPaintAreThoseOfThePlaceItGrewFrom) {
  const GuidanceBuffers guidance = paint({.painting = false}).guidance;
  const PaintedClasses classes = classes_of_paint(guidance, guidance.ground_from);
  for (std::size_t i = 0; i < guidance.ground_from.size(); ++i)
    ASSERT_EQ(classes.land_cover[i], guidance.land_cover[guidance.ground_from[i]]) << i;
}

// Grass that overhangs a brook must not be copied into rivers.
TEST_F(ExamplePaintings, WaterUnderThePaintOfItsBanksIsToldOfAsThatPaint) {
  LitPicture picture = lit();
  for (int y = 60; y < 64; ++y)
    for (int x = 0; x < 96; ++x) picture.guidance.land_cover(x, y) = LandCoverClass::water;
  const GuidanceBuffers g =
      paint_example(world_, palette_, std::move(picture), {}, silent_progress()).guidance;
  const auto covered = [&](const Grid<std::uint32_t>& from) {
    int count = 0;
    for (std::size_t i = 0; i < from.size(); ++i)
      count +=
          g.land_cover[i] == LandCoverClass::water && g.land_cover[from[i]] != LandCoverClass::water
              ? 1
              : 0;
    return count;
  };
  EXPECT_GT(covered(g.ground_from), 0);
  EXPECT_GT(covered(g.painted_from), 0);
}

}  // namespace
}  // namespace belvedere
