#include "renderer/world/world_notes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

using test::small_scene;

FileNotes notes_of(const LoadedScene& loaded) {
  return make_world_notes(loaded, make_world(loaded, silent_progress()));
}

TEST(WorldNotes, SayCameraAndSun) {
  const FileNotes notes = notes_of(
      small_scene({"camera.azimuth_deg=12.5", "sun.azimuth_deg=250", "sun.altitude_deg=31"}));
  EXPECT_EQ(notes.at("belvedere:camera"),
            "perspective eye 6000.000 -4000.000 6000.000 azimuth 12.500000 pitch -22.000000 field "
            "50.0000");
  EXPECT_EQ(notes.at("belvedere:sun"), "azimuth 250.0000 altitude 31.0000");
  EXPECT_EQ(notes.at("belvedere:crs"), "none") << "synthetic terrain has no position";
}

TEST(WorldNotes, TheSceneInThemMakesThePictureAgain) {
  const LoadedScene loaded = small_scene({"seed=77", "title=Hills"});
  const std::string written = notes_of(loaded).at("belvedere:scene");
  EXPECT_EQ(written, write_scene(loaded.scene));
  EXPECT_EQ(parse_scene(written, "again.toml", ".", {}).scene.seed, 77U);
}

TEST(WorldNotes, NameTheCoordinateSystemAndEveryFileThatWasRead) {
  const test::Folder folder;
  write_raster(folder / "dem.tif", Raster<float>{Grid<float>(60, 60, 500.F),
                                                 {500000.0, 5200000.0, 100.0, 100.0},
                                                 normalize_crs("EPSG:32632")});
  const auto notes = [&] {
    return notes_of(
        parse_scene("version = 1\n[[terrain.sources]]\nfile = \"dem.tif\"\n[camera]\nposition = "
                    "[503000, 5190000]\n"
                    "height_m = 3000\n[output]\nwidth = 32\nheight = 32\n",
                    "s.toml", folder.path(), {}));
  };
  const auto inputs = [](const FileNotes& all) {
    std::string text;
    for (const auto& [key, value] : all)
      if ((key + value).find("dem.tif") != std::string::npos && key != "belvedere:scene")
        text += key + value;
    return text;
  };
  const FileNotes before = notes();
  EXPECT_EQ(before.at("belvedere:crs"), "EPSG:32632");
  EXPECT_NE(inputs(before), "");
  // The recorded hash of a file changes with its cells.
  write_raster(folder / "dem.tif", Raster<float>{Grid<float>(60, 60, 501.F),
                                                 {500000.0, 5200000.0, 100.0, 100.0},
                                                 normalize_crs("EPSG:32632")});
  EXPECT_NE(inputs(notes()), inputs(before));
}

}  // namespace
}  // namespace belvedere
