#include "tools/cli/new/contact_sheet.h"

#include <gtest/gtest.h>

#include <limits>

#include "renderer/image/image_io.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/renderer/compose/synthetic_region.h"
#include "tests/scenes.h"

namespace belvedere::tools {
namespace {

TEST(ContactSheet, DraftsAreSmallAndOfCoarserGround) {
  LoadedScene scene = test::small_scene();
  scene.scene.output.width = 2400;
  scene.scene.output.height = 1200;
  const LoadedScene draft = make_small_draft(scene, 500, 0.5);
  EXPECT_EQ(draft.scene.output.width, 500);
  EXPECT_EQ(draft.scene.output.height, 250);
  EXPECT_EQ(draft.scene.terrain.preview_mcells, 0.5);
  EXPECT_FALSE(draft.scene.copies());
  EXPECT_EQ(draft.scene.output.formats, std::vector<std::string>{"png"});
}

TEST(ContactSheet, HoldsEveryPictureInItsPlace) {
  const test::Folder folder;
  const LoadedScene first = make_small_draft(test::small_scene(), 96, 0.0);
  const LoadedScene second =
      make_small_draft(test::small_scene({"camera.azimuth_deg=30"}), 96, 0.0);
  write_contact_sheet(folder / "both.png", {first, second, first}, {"1", "2", "3"}, {});
  const Grid<glm::vec3> sheet = read_picture(folder / "both.png");
  EXPECT_EQ(sheet.width(), 2 * 96 + 3 * 12);
  EXPECT_GT(sheet.height(), 2 * 80);
  // The third picture is the first again, below it; the second is another. Their numbers stand
  // below them.
  int rows = 0;
  while (rows < 80 && sheet(12 + 48, 12 + rows) != sheet(0, 0)) ++rows;
  EXPECT_GE(rows, 64);
  int same = 0, other = 0, dark = 0;
  const int down = (sheet.height() - 12) / 2;
  for (const auto [x, y] : test::cells(96, 64)) {
    same += sheet(12 + x, 12 + y) == sheet(12 + x, 12 + down + y) ? 1 : 0;
    other += sheet(12 + x, 12 + y) == sheet(12 + 96 + 12 + x, 12 + y) ? 1 : 0;
  }
  for (const auto [x, y] : test::cells({12, 12 + rows, 40, 12 + rows + 24}))
    dark += sheet(x, y).x < 0.3F ? 1 : 0;
  EXPECT_EQ(same, 96 * 64);
  EXPECT_LT(other, 96 * 64 / 2);
  EXPECT_GT(dark, 10);
}

// Several drafts share their ground, which is read once: each equals the same draft alone, voids
// and coarser cells included.
TEST(ContactSheet, SharedGroundIsTheGround) {
  const test::Folder folder;
  Raster<float> hills = test::synthetic_raster(20.0, test::chain, 120);
  for (const auto [x, y] : test::cells({50, 40, 60, 48}))
    hills.cells(x, y) = std::numeric_limits<float>::quiet_NaN();
  write_raster(folder / "hills.tif", hills);
  const auto draft = [&](const std::string& azimuth) {
    return make_small_draft(
        parse_scene("version = 1\n[[terrain.sources]]\nfile = \"hills.tif\"\n[camera]\nposition = "
                    "[610000, 5198000]\n"
                    "height_m = 6000\nazimuth_deg = " +
                        azimuth + "\n[output]\nwidth = 480\nheight = 240\nsheet_width_mm = 480\n",
                    "hills.toml", folder.path(), {}),
        96, 0.004);
  };
  write_contact_sheet(folder / "alone.png", {draft("0")}, {"1"}, {});
  write_contact_sheet(folder / "both.png", {draft("0"), draft("20")}, {"1", "2"}, {});
  const Grid<glm::vec3> alone = read_picture(folder / "alone.png");
  const Grid<glm::vec3> both = read_picture(folder / "both.png");
  int other = 0;
  for (const auto [x, y] : test::cells({12, 12, 12 + 96, 12 + 64}))
    other += alone(x, y) == both(x, y) ? 0 : 1;
  EXPECT_EQ(other, 0);
}

}  // namespace
}  // namespace belvedere::tools
