#include "renderer/world/style/scene_style.h"

#include <gtest/gtest.h>

#include "renderer/style/style_file.h"
#include "tests/files.h"

namespace belvedere {
namespace {

LoadedScene scene_beside(const test::Folder& folder, const std::string& text) {
  return parse_scene("version = 1\n" + text, "scene.toml", folder.path(), {});
}

// A style file with the winter palette.
void write_mine(const test::Folder& folder) {
  Style style;
  style.name = "mine";
  style.palette = read_palette("winter");
  test::write_bytes(folder.path() + "/mine.toml", style_text(style));
}

TEST(SceneStyle, ItsPaletteIsTheScenesUnlessThatNamesOne) {
  const test::Folder folder;
  write_mine(folder);
  EXPECT_TRUE(named_palette(scene_beside(folder, "style = \"mine.toml\"\n")).winter);
  EXPECT_FALSE(
      named_palette(scene_beside(folder, "style = \"mine.toml\"\npalette = \"summer\"\n")).winter);
  EXPECT_FALSE(named_palette(scene_beside(folder, "")).winter);
  EXPECT_FALSE(named_style(scene_beside(folder, "")).has_value());
  EXPECT_EQ(named_style(scene_beside(folder, "style = \"mine.toml\"\n"))->name, "mine");
}

TEST(SceneStyle, SharesComeFromTheScene) {
  const test::Folder folder;
  const LoadedScene loaded = scene_beside(
      folder, "seed = 5\n[style]\nfile = \"mine.toml\"\nbrushwork = 0.5\nscale = 2\ncanvas = 0\n");
  const StylePaintParameters p = to_style_parameters(loaded.scene, 0.7, {300, 200});
  EXPECT_EQ(p.seed, 5U);
  EXPECT_EQ(p.brushwork, 0.5);
  EXPECT_EQ(p.sky, 1.0);
  EXPECT_EQ(p.scale, 2.0);
  EXPECT_EQ(p.weave, 0.0);
  EXPECT_EQ(p.paint_relief, StylePaintParameters{}.paint_relief);
  EXPECT_EQ(p.pixels_per_unit, 0.7);
  EXPECT_EQ(p.sheet_px, glm::ivec2(300, 200));
}

}  // namespace
}  // namespace belvedere
