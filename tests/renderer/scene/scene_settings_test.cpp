#include "renderer/scene/scene_settings.h"

#include <gtest/gtest.h>

#include <utility>

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
  EXPECT_FALSE(draft.copies());
  EXPECT_EQ(draft.water.mirror, "column");
  // Nothing else of the scene changes.
  Scene rest = draft;
  rest.output = scene.output;
  rest.sampling = scene.sampling;
  rest.synthesis.enabled = scene.synthesis.enabled;
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

// Strokes below a third of a pixel are painted larger instead of in larger numbers.
TEST(Draft, SmallerPicturesArePaintedAsOnASmallerSheet) {
  Scene scene;
  scene.output.sheet_width_mm = 1200.0;
  for (const auto& [width, pixels_per_unit] :
       {std::pair{2400, 1.0}, {800, 1.0 / 3.0}, {720, 0.3}, {96, 0.3}}) {
    scene.output.width = width;
    EXPECT_DOUBLE_EQ(scene.pixels_per_unit(), pixels_per_unit) << width;
  }
}

}  // namespace
}  // namespace belvedere
