#include "renderer/live/rungs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/scenes.h"

namespace belvedere {
namespace {

using testing::IsEmpty;

// A scene of a file, whose ground unlike synthetic terrain has coarser levels.
LoadedScene file_scene(const std::vector<std::string>& settings = {}) {
  return parse_scene(
      "version = 1\n[[terrain.sources]]\nfile = \"a.tif\"\n[camera]\nposition = [0, 0]\n[output]\n"
      "width = 3000\nheight = 1200\n",
      "a.toml", ".", {.data_folders = {}, .settings = settings});
}

TEST(Rungs, EachHasMoreThanTheOneBefore) {
  ASSERT_GE(rungs().size(), 2U);
  for (std::size_t i = 1; i < rungs().size(); ++i) {
    const Rung& before = rungs()[i - 1];
    const Rung& rung = rungs()[i];
    EXPECT_GE(rung.max_width_px, before.max_width_px);
    EXPECT_GE(rung.strokes, before.strokes);
    EXPECT_LE(rung.without.size(), before.without.size());
    EXPECT_NE(rung.name, before.name);
  }
}

TEST(Rungs, OnlyTheLastLacksNothing) {
  for (const Rung& rung : rungs()) EXPECT_EQ(rung.is_last(), &rung == &rungs().back()) << rung.name;
  EXPECT_TRUE(rungs().back().strokes);
}

// What a rung leaves out is said, so that nobody takes its picture for the finished one.
TEST(Rungs, SayWhatTheyLeaveOut) {
  for (const Rung& rung : rungs()) {
    const auto says = [&](const char* words) {
      return std::find(rung.without.begin(), rung.without.end(), words) != rung.without.end();
    };
    EXPECT_EQ(says("strokes"), !rung.strokes) << rung.name;
    EXPECT_EQ(says("rock relief"), !rung.strokes) << rung.name;
  }
}

TEST(Rungs, TheLastDrawsTheSceneAsItIs) {
  for (const LoadedScene& scene :
       {test::small_scene(), file_scene({"output.width=800", "output.height=320"})}) {
    const LoadedScene drawn = scene_of_rung(scene, rungs().back());
    EXPECT_EQ(write_scene(drawn.scene), write_scene(scene.scene));
    EXPECT_EQ(drawn.folder, scene.folder);
  }
}

TEST(Rungs, LargeSheetsAreDrawnSmallerInTheirShape) {
  const Scene drawn =
      scene_of_rung(file_scene(), {.name = {}, .without = {}, .max_width_px = 400}).scene;
  EXPECT_EQ(drawn.output.width, 400);
  EXPECT_EQ(drawn.output.height, 160);
  EXPECT_EQ(drawn.output.sheet_width_mm, file_scene().scene.output.sheet_width_mm)
      << "strokes keep their size on the sheet";
  const Scene small =
      scene_of_rung(test::small_scene(), {.name = {}, .without = {}, .max_width_px = 400}).scene;
  EXPECT_EQ(small.output.width, 96) << "none is drawn larger";
  EXPECT_EQ(small.output.height, 80);
  const Scene flat = scene_of_rung(file_scene({"output.height=20"}),
                                   {.name = {}, .without = {}, .max_width_px = 100})
                         .scene;
  EXPECT_EQ(flat.output.height, 16) << "the smallest picture there is";
}

TEST(Rungs, PreviewsHaveFewRaysAndCoarseGroundAndCopyNothing) {
  const LoadedScene scene =
      test::small_scene({"sampling.pixel_samples=9", "sampling.shadow_rays=6",
                         "sampling.sky_directions=24", "synthesis.enabled=true"});
  const Scene drawn = scene_of_rung(scene, rungs().front()).scene;
  EXPECT_EQ(drawn.sampling.pixel_samples, 1);
  EXPECT_EQ(drawn.sampling.shadow_rays, 1);
  EXPECT_EQ(drawn.sampling.sky_directions, 4);
  EXPECT_EQ(drawn.water.mirror, "column");
  EXPECT_FALSE(drawn.copies());
  EXPECT_EQ(
      scene_of_rung(test::small_scene({"water.mirror=none"}), rungs().front()).scene.water.mirror,
      "none");
  EXPECT_EQ(drawn.terrain.preview_mcells, 1.0);
}

}  // namespace
}  // namespace belvedere
