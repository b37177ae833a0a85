#include "renderer/live/rungs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

using testing::IsEmpty;

// A scene of a file, which unlike synthetic terrain can be read in coarser cells.
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
    EXPECT_GE(rung.rock_relief, before.rock_relief);
    EXPECT_LE(rung.quick_rays, before.quick_rays);
    EXPECT_LE(rung.without.size(), before.without.size());
    EXPECT_NE(rung.name, before.name);
  }
}

TEST(Rungs, OnlyTheLastLacksNothing) {
  for (const Rung& rung : rungs()) EXPECT_EQ(rung.is_last(), &rung == &rungs().back()) << rung.name;
  const Rung& last = rungs().back();
  EXPECT_EQ(last.max_mcells, 0.0);
  EXPECT_TRUE(last.rock_relief && last.strokes && last.copied && !last.quick_rays);
}

// What a rung leaves out is said, so that nobody takes its picture for the finished one.
TEST(Rungs, SayWhatTheyLeaveOut) {
  for (const Rung& rung : rungs()) {
    const auto says = [&](const char* words) {
      return std::find(rung.without.begin(), rung.without.end(), words) != rung.without.end();
    };
    EXPECT_EQ(says("strokes"), !rung.strokes) << rung.name;
    EXPECT_EQ(says("rock relief"), !rung.rock_relief) << rung.name;
    EXPECT_EQ(says("fine ground"), rung.max_mcells > 0.0) << rung.name;
  }
}

TEST(Rungs, TheLastDrawsTheSceneAsItIs) {
  for (const LoadedScene& scene :
       {test::small_scene(), file_scene({"output.width=800", "output.height=320"})}) {
    const LoadedScene drawn = scene_of_rung(scene, rungs().back(), {100.0, 10.0});
    EXPECT_EQ(write_scene(drawn.scene), write_scene(scene.scene));
    EXPECT_EQ(drawn.folder, scene.folder);
  }
}

TEST(Rungs, LargeSheetsAreDrawnSmallerInTheirShape) {
  const Scene drawn =
      scene_of_rung(file_scene(), {.name = {}, .without = {}, .max_width_px = 400}, {}).scene;
  EXPECT_EQ(drawn.output.width, 400);
  EXPECT_EQ(drawn.output.height, 160);
  EXPECT_EQ(drawn.output.sheet_width_mm, file_scene().scene.output.sheet_width_mm)
      << "strokes keep their size on the sheet";
  const Scene small =
      scene_of_rung(test::small_scene(), {.name = {}, .without = {}, .max_width_px = 400}, {})
          .scene;
  EXPECT_EQ(small.output.width, 96) << "none is drawn larger";
  EXPECT_EQ(small.output.height, 80);
  const Scene flat = scene_of_rung(file_scene({"output.height=20"}),
                                   {.name = {}, .without = {}, .max_width_px = 100}, {})
                         .scene;
  EXPECT_EQ(flat.output.height, 16) << "the smallest picture there is";
}

TEST(Rungs, CellsAreWholeMultiplesUntilTheyAreFewEnough) {
  const auto cell_m = [](double mcells, double max_mcells) {
    return scene_of_rung(file_scene(), {.name = {}, .without = {}, .max_mcells = max_mcells},
                         {mcells, 30.0})
        .scene.terrain.dem.cell_m;
  };
  EXPECT_EQ(cell_m(9.0, 1.0), 90.0);
  EXPECT_EQ(cell_m(9.0, 2.25), 60.0);
  EXPECT_EQ(cell_m(9.1, 1.0), 90.0) << "a little more is no reason for coarser cells";
  EXPECT_EQ(cell_m(12.0, 1.0), 120.0);
  EXPECT_EQ(cell_m(0.9, 1.0), 0.0) << "as the files have them";
  EXPECT_EQ(cell_m(9.0, 0.0), 0.0) << "no limit";
  EXPECT_EQ(scene_of_rung(file_scene({"terrain.max_mcells=5"}),
                          {.name = {}, .without = {}, .max_mcells = 1.0}, {9.0, 30.0})
                .scene.terrain.max_mcells,
            0.0)
      << "no windows of finer cells";
  EXPECT_EQ(scene_of_rung(test::small_scene(), {.name = {}, .without = {}, .max_mcells = 0.001},
                          {9.0, 100.0})
                .scene.terrain.dem.cell_m,
            0.0)
      << "synthetic terrain is another one in other cells";
}

TEST(Rungs, QuickRaysAreFew) {
  const LoadedScene scene = test::small_scene(
      {"sampling.pixel_samples=9", "sampling.shadow_rays=6", "sampling.sky_directions=24"});
  const Scene quick =
      scene_of_rung(scene, {.name = {}, .without = {}, .quick_rays = true}, {}).scene;
  EXPECT_EQ(quick.sampling.pixel_samples, 1);
  EXPECT_EQ(quick.sampling.shadow_rays, 1);
  EXPECT_EQ(quick.sampling.sky_directions, 4);
  EXPECT_EQ(quick.water.mirror, "column");
  EXPECT_EQ(scene_of_rung(test::small_scene({"water.mirror=none"}),
                          {.name = {}, .without = {}, .quick_rays = true}, {})
                .scene.water.mirror,
            "none");
  const Scene slow = scene_of_rung(scene, {}, {}).scene;
  EXPECT_EQ(slow.sampling.pixel_samples, 9);
  EXPECT_EQ(slow.water.mirror, "traced");
}

TEST(Rungs, CopyOnlyWhereTheyMay) {
  const LoadedScene scene = test::small_scene({"synthesis.enabled=true"});
  EXPECT_TRUE(scene_of_rung(scene, {.name = {}, .without = {}, .copied = true}, {})
                  .scene.synthesis.enabled);
  EXPECT_FALSE(scene_of_rung(scene, {.name = {}, .without = {}, .copied = false}, {})
                   .scene.synthesis.enabled);
}

TEST(Rungs, TheSizeOfTheGroundIsThatOfItsFiles) {
  const GroundSize synthetic = ground_size_of(test::small_scene());
  EXPECT_DOUBLE_EQ(synthetic.mcells, 0.0144);
  EXPECT_DOUBLE_EQ(synthetic.cell_m, 100.0);
  const test::Folder folder;
  write_raster(folder / "a.tif", Raster<float>{Grid<float>(60, 50, 7.F),
                                               {600000.0, 5200000.0, 25.0, 25.0},
                                               normalize_crs("EPSG:32632")});
  const auto scene = [&](const std::vector<std::string>& settings = {}) {
    return parse_scene(
        "version = 1\n[[terrain.sources]]\nfile = \"a.tif\"\n[camera]\nposition = [0, 0]\n",
        "a.toml", folder.path(), {.data_folders = {}, .settings = settings});
  };
  EXPECT_DOUBLE_EQ(ground_size_of(scene()).mcells, 0.003);
  EXPECT_DOUBLE_EQ(ground_size_of(scene()).cell_m, 25.0);
  EXPECT_DOUBLE_EQ(ground_size_of(scene({"terrain.cell_m=50"})).cell_m, 50.0);
  EXPECT_NEAR(ground_size_of(scene({"terrain.cell_m=50"})).mcells, 0.00075, 0.00005);
  EXPECT_EQ(test::error_of([&] {
              ground_size_of(scene({"terrain.sources=[{ file = \"none.tif\" }]"}));
            }).kind(),
            ErrorKind::input);
}

}  // namespace
}  // namespace belvedere
