#include "renderer/world/scene_style.h"

#include <gtest/gtest.h>

#include "renderer/style/style_file.h"
#include "tests/files.h"
#include "tests/renderer/style/styled_sheet.h"

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

using enum LandCoverClass;

glm::vec3 lit(const Palette& palette, LandCoverClass id) {
  return glm::vec3(to_oklab(palette_colour(palette, id, 1500.0, 0.7)));
}

TEST(WinterStyle, OpenGroundIsAsWhiteAsTheStylesSnow) {
  for (const char* name : {"segantini", "gogh", "bruegel"}) {
    const Style summer = read_style(std::string("data/styles/") + name + ".toml");
    const Style winter = winter_style(summer);
    EXPECT_TRUE(winter.palette.winter);
    const glm::vec3 snow_colour = lit(summer.palette, snow);
    for (const LandCoverClass id : {pasture, alpine_grass, valley_floor, scree})
      EXPECT_NEAR(lit(winter.palette, id).x, snow_colour.x, 0.06F) << name << " " << class_name(id);
    EXPECT_EQ(lit(winter.palette, rock), lit(summer.palette, rock)) << name;
    EXPECT_LT(lit(winter.palette, forest).x, snow_colour.x - 0.15F) << name;
  }
}

TEST(WinterStyle, SnowHasTheStrokesOfSnow) {
  Style style = test::make_style();
  style.palette = read_palette("summer");
  style.brushwork[static_cast<std::size_t>(snow)].width_px = 4.0;
  const Style winter = winter_style(style);
  EXPECT_EQ(winter.brushwork[static_cast<std::size_t>(pasture)].width_px, 4.0);
  EXPECT_NE(winter.brushwork[static_cast<std::size_t>(forest)].width_px, 4.0);
}

}  // namespace
}  // namespace belvedere
