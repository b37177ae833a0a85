#include "renderer/scene/draft.h"

#include <gtest/gtest.h>

#include <utility>

#include "renderer/scene/scene_file.h"

namespace belvedere {
namespace {

TEST(Draft, IsAThirdOfTheSheetWithOneSampleAndStrokesAlone) {
  Scene scene;
  scene.output.width = 2400;
  scene.output.height = 1100;
  scene.output.sheet_width_mm = 1200.0;
  scene.sampling.pixel_samples = 4;
  scene.sampling.sky_directions = 16;
  const Scene draft = make_draft(scene);
  EXPECT_EQ(draft.output.width, 800);
  EXPECT_EQ(draft.output.height, 367);  // 366.7
  EXPECT_EQ(draft.output.sheet_width_mm, 1200.0);
  EXPECT_DOUBLE_EQ(draft.pixels_per_unit(), scene.pixels_per_unit() / 3.0);
  EXPECT_EQ(draft.sampling.pixel_samples, 1);
  EXPECT_EQ(draft.sampling.sky_directions, 4);
  EXPECT_FALSE(draft.synthesis.enabled);
  EXPECT_EQ(draft.water.mirror, "column");
  // Nothing else of the scene changes.
  Scene rest = draft;
  rest.output = scene.output;
  rest.sampling = scene.sampling;
  rest.synthesis.enabled = true;
  rest.water.mirror = scene.water.mirror;
  EXPECT_EQ(write_scene(rest), write_scene(scene));
}

TEST(Draft, IsNeverLargerThanTheSceneNorTiny) {
  Scene scene;
  scene.output.width = 100;
  scene.output.height = 50;
  scene.sampling.sky_directions = 0;
  const Scene draft = make_draft(scene);
  EXPECT_EQ(draft.output.width, 64);
  EXPECT_EQ(draft.output.height, 50);
  EXPECT_EQ(draft.sampling.sky_directions, 0);
  for (const auto& [px, third] :
       {std::pair{300, 100}, {301, 100}, {302, 101}, {193, 64}, {10, 10}}) {
    scene.output.width = px;
    EXPECT_EQ(make_draft(scene).output.width, third) << px;
  }
}

}  // namespace
}  // namespace belvedere
