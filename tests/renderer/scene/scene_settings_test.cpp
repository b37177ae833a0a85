#include "renderer/scene/scene_settings.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {
namespace {

TEST(StyleKey, ANameAloneIsItsFile) {
  const LoadedScene scene =
      parse_scene("version = 1\nstyle = \"mine.toml\"\n", "scene.toml", ".", {});
  EXPECT_EQ(scene.scene.style.file, "mine.toml");
  EXPECT_EQ(scene.scene.style.brushwork, 1.0);
  EXPECT_EQ(parse_scene("version = 1\n", "scene.toml", ".",
                        {.data_folders = {}, .settings = {"style = mine.toml"}})
                .scene.style.file,
            "mine.toml");
  const LoadedScene table =
      parse_scene("version = 1\n[style]\nfile = \"a.toml\"\nsky = 0.5\n", "scene.toml", ".",
                  {.data_folders = {}, .settings = {"style=b.toml", "style.contour_lines=0.7"}});
  EXPECT_EQ(table.scene.style.file, "b.toml");
  EXPECT_EQ(table.scene.style.sky, 0.5);
  EXPECT_EQ(table.scene.style.contour_lines, 0.7);
}

TEST(StyleKey, BringsItsPalette) {
  const auto read = [](const std::string& text) {
    return parse_scene("version = 1\n" + text, "scene.toml", ".", {}).scene;
  };
  EXPECT_EQ(read("style = \"a.toml\"\n").palette, "");
  EXPECT_EQ(read("style = \"a.toml\"\npalette = \"winter\"\n").palette, "winter");
  EXPECT_THROW(read("palette = \"\"\n"), Error);
}

// Copying is for paintings: where only the program's own sheet would be copied, its strokes are
// painted directly, unless the scene says otherwise.
TEST(SynthesisKey, CopiesWhereTheSceneHasAnExemplar) {
  const auto copies = [](const std::string& text) {
    return parse_scene("version = 1\n" + text, "scene.toml", ".", {}).scene.copies();
  };
  EXPECT_FALSE(copies(""));
  EXPECT_FALSE(copies("style = \"a.toml\"\n"));
  EXPECT_TRUE(copies("[[exemplar]]\nwidth = 400\n"));
  EXPECT_TRUE(copies("style = \"a.toml\"\n[[exemplar]]\nwidth = 400\n"));
  EXPECT_TRUE(copies("[[exemplar]]\npicture = \"a.tif\"\nclasses = \"a.png\"\n"));
  EXPECT_TRUE(copies("[synthesis]\nenabled = true\n"));
  EXPECT_FALSE(copies("[synthesis]\nenabled = \"auto\"\n"));
  EXPECT_TRUE(copies("[[exemplar]]\nwidth = 400\n[synthesis]\nenabled = \"auto\"\n"));
  EXPECT_FALSE(copies("[[exemplar]]\nwidth = 400\n[synthesis]\nenabled = false\n"));
  EXPECT_THROW(copies("[synthesis]\nenabled = \"yes\"\n"), Error);
}

}  // namespace
}  // namespace belvedere
