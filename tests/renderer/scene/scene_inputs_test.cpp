// The files that scenes name: where they are searched, which are required. Declared in
// renderer/scene/scene_file.h.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "renderer/scene/scene_file.h"
#include "tests/files.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using test::input_error;
using test::usage_error;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class SceneFolders : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* file : {"scenes/here.tif", "data/alps/dem.tif", "secret/x.tif"})
      root_.write(file, "x");
  }
  std::string path(const std::string& relative) const { return root_ / relative; }
  LoadedScene load(const std::string& text, bool with_data = true) const {
    return parse_scene("version = 1\n" + text, "s.toml", path("scenes"),
                       {.data_folders = with_data ? std::vector<std::string>{path("data")}
                                                  : std::vector<std::string>{},
                        .settings = {}});
  }
  test::Folder root_;
};

TEST_F(SceneFolders, FilesAreFoundBesideTheSceneAndInDataFolders) {
  const LoadedScene scene = load("");
  EXPECT_EQ(find_scene_file(scene, "here.tif"), fs::canonical(path("scenes/here.tif")));
  EXPECT_EQ(find_scene_file(scene, "alps/dem.tif"), fs::canonical(path("data/alps/dem.tif")));
  EXPECT_EQ(find_scene_file(scene, "../data/alps/dem.tif"),
            fs::canonical(path("data/alps/dem.tif")));
  EXPECT_EQ(find_scene_file(scene, path("data/alps/dem.tif")),
            fs::canonical(path("data/alps/dem.tif")));
  EXPECT_EQ(find_scene_file(scene, "alps/none.tif"), "");
  EXPECT_EQ(find_scene_file(scene, ""), "");
  EXPECT_EQ(find_named_file(scene, "palettes", "winter"), "winter");
  EXPECT_THAT(input_error([&] { find_named_file(scene, "palettes", "none.toml"); }),
              HasSubstr("summer"));
}

TEST_F(SceneFolders, PathsMayNotLeaveTheAllowedFolders) {
  for (const std::string& file :
       {std::string("../secret/x.tif"), std::string("../secret/absent.tif"), path("secret/x.tif"),
        std::string("/etc/passwd"), std::string("../../../../../../../../etc/passwd"),
        std::string("../scenes_not/x.tif"), std::string("..")})
    EXPECT_THAT(usage_error([&] { load("[[terrain.sources]]\nfile = \"" + file + "\"\n"); }),
                AllOf(StartsWith("s.toml:3:8: "), HasSubstr("outside"), HasSubstr("--data")))
        << file;
  EXPECT_THAT(
      usage_error([&] { load("[[terrain.sources]]\nfile = \"../data/alps/dem.tif\"\n", false); }),
      HasSubstr("outside"));
  // Links: to a file, to a folder, through two of them, and one that leads into an allowed folder.
  fs::create_symlink("../secret/x.tif", path("scenes/link.tif"));
  fs::create_directory_symlink(path("secret"), path("scenes/folder"));
  fs::create_symlink("link.tif", path("scenes/link2.tif"));
  fs::create_symlink("../data/alps/dem.tif", path("scenes/allowed.tif"));
  const LoadedScene scene = load("");
  for (const char* file : {"link.tif", "folder/x.tif", "link2.tif", "folder/none.tif"})
    EXPECT_THAT(usage_error([&] { find_scene_file(scene, file); }), HasSubstr("outside")) << file;
  EXPECT_EQ(find_scene_file(scene, "allowed.tif"), fs::canonical(path("data/alps/dem.tif")));
  EXPECT_THAT(usage_error([&] { find_scene_file(scene, std::string("here.tif\0../x", 13)); }),
              HasSubstr("control characters"));
}

TEST_F(SceneFolders, AllMissingFilesInOneMessage) {
  const LoadedScene scene = load(R"(
[[terrain.sources]]
file = "alps/dem.tif"
[[terrain.sources]]
file = "alps/south.tif"
origin = "Tyrol survey"
licence = "CC0"
get_from = "https://example.org/south"
[output]
profile = "press.icc"
[[exemplar]]
picture = "scan.png"
classes = "mask.png"
optional = true
)");
  const std::string message = input_error([&] { require_scene_files(scene); });
  EXPECT_THAT(
      message,
      AllOf(HasSubstr("2 files"), HasSubstr("alps/south.tif (terrain.sources.1.file)"),
            HasSubstr("Tyrol survey"), HasSubstr("CC0"), HasSubstr("https://example.org/south"),
            HasSubstr("press.icc"), HasSubstr(path("data"))));
  EXPECT_THAT(message, AllOf(Not(HasSubstr("alps/dem.tif")), Not(HasSubstr("scan.png"))));
  EXPECT_EQ(scene_inputs(scene).size(), 5U);
  EXPECT_NO_THROW(require_scene_files(load("[[terrain.sources]]\nfile = \"alps/dem.tif\"\n")));
}

// A name that is nearly that of an existing file: another case, or letters stored otherwise. Never
// read as if it were meant.
TEST_F(SceneFolders, MissingFilesNameWhatIsNearlyCalledSo) {
  root_.write("data/alps/Zu\u0308rich.tif", "x");
  const LoadedScene scene = load(
      "palette = \"Mine.toml\"\n[[terrain.sources]]\nfile = \"Alps/DEM.tif\"\n"
      "[[terrain.sources]]\nfile = \"alps/Z\u00fcrich.tif\"\n");
  EXPECT_EQ(find_scene_file(scene, "Alps/DEM.tif"), "");
  EXPECT_THAT(
      input_error([&] { require_scene_files(scene); }),
      AllOf(HasSubstr("Alps/DEM.tif (terrain.sources.0.file); there is \"" +
                      path("data/alps/dem.tif")),
            HasSubstr("(terrain.sources.1.file); there is a file whose name looks the same"),
            HasSubstr("NFD")));
  root_.write("scenes/mine.toml", "x");
  EXPECT_THAT(input_error([&] { find_named_file(scene, "palettes", "Mine.toml"); }),
              HasSubstr("mine.toml\": upper and lower case differ"));
  EXPECT_THAT(missing_scene_file(scene, "alps/Dem.tif").found(), HasSubstr("alps/dem.tif"));
}

TEST_F(SceneFolders, CreditsAreSaidOnceAndWithTheirLicence) {
  const LoadedScene scene = load(
      "[[terrain.sources]]\nfile = \"alps/dem.tif\"\norigin = \"Tyrol survey\"\nlicence = \"CC0\"\n"
      "[[terrain.sources]]\nfile = \"alps/south.tif\"\norigin = \"Tyrol survey\"\nlicence = "
      "\"CC0\"\n"
      "[[terrain.sources]]\nfile = \"here.tif\"\n"
      "[land_cover]\nlegend = \"nlcd\"\n[[land_cover.sources]]\nfile = \"here.tif\"\norigin = "
      "\"WorldCover\"\n");
  EXPECT_THAT(source_credits(scene), ElementsAre("Tyrol survey (CC0)", "WorldCover"));
  EXPECT_THAT(source_credits(load("")), IsEmpty());
}

TEST_F(SceneFolders, InputsAreFilesAndNoBuiltInNames) {
  EXPECT_THAT(scene_inputs(load("")), IsEmpty());
  EXPECT_THAT(scene_inputs(load("palette = \"winter\"\n[land_cover]\nlegend = "
                                "\"nlcd\"\n[[land_cover.sources]]\nfile = \"here.tif\"\n")),
              testing::SizeIs(1));
  const std::vector<SceneInput> inputs =
      scene_inputs(load("palette = \"mine.toml\"\n[[terrain.sources]]\nfile = "
                        "\"alps/dem.tif\"\norigin = \"Tyrol\"\n"));
  std::vector<std::string> keys;
  for (const SceneInput& input : inputs) keys.push_back(input.key);
  std::sort(keys.begin(), keys.end());
  ASSERT_THAT(keys, ElementsAre("palette", "terrain.sources.0.file"));
  for (const SceneInput& input : inputs) {
    const bool dem = input.key != "palette";
    EXPECT_EQ(input.file, dem ? "alps/dem.tif" : "mine.toml");
    EXPECT_EQ(input.path, dem ? fs::canonical(path("data/alps/dem.tif")).string() : "")
        << "empty: it is missing";
    EXPECT_EQ(input.origin, dem ? "Tyrol" : "");
    EXPECT_FALSE(input.optional);
  }
}

TEST_F(SceneFolders, FilesOfBlocksThatAreOffAreNoInputs) {
  const auto loaded = [&](const std::string& more) {
    return load("[[features]]\nsource = \"none.gpkg\"\nkind = \"road\"\norigin = \"Tyrol\"\n" +
                more);
  };
  EXPECT_THAT(scene_inputs(loaded("enabled = false\n")), IsEmpty());
  EXPECT_THAT(source_credits(loaded("enabled = false\n")), IsEmpty());
  EXPECT_NO_THROW(require_scene_files(loaded("enabled = false\n")));
  EXPECT_THAT(scene_inputs(loaded("")), testing::SizeIs(1));
}

// Beside the scene first, then the folders in their order.
TEST_F(SceneFolders, TheFirstFolderThatHasTheFileGivesIt) {
  root_.write("data/here.tif", "another");
  EXPECT_EQ(find_scene_file(load(""), "here.tif"), fs::canonical(path("scenes/here.tif")));
  fs::remove(path("scenes/here.tif"));
  EXPECT_EQ(find_scene_file(load(""), "here.tif"), fs::canonical(path("data/here.tif")));
}

}  // namespace
}  // namespace belvedere
