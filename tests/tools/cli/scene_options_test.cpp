#include "tools/cli/scene_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/files.h"
#include "tests/tools/read_options.h"

namespace belvedere::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

SceneOptions read_scene_options(const std::string& line) {
  return test::read_options<SceneOptions>(
      [](CommandOptions& command, SceneOptions& options) { add_scene_options(command, options); },
      line);
}

TEST(SceneOptions, AreRead) {
  const SceneOptions options = read_scene_options(
      "a.toml --data x --data y --set seed=3 --set palette=winter --threads 2 -q --json --memory "
      "100");
  EXPECT_EQ(options.scene, "a.toml");
  EXPECT_THAT(options.files.data_folders, ElementsAre("x", "y"));
  EXPECT_THAT(options.files.settings, ElementsAre("seed=3", "palette=winter"));
  EXPECT_EQ(options.threads, 2);
  EXPECT_EQ(options.memory_mib, 100);
  EXPECT_TRUE(options.quiet);
  EXPECT_TRUE(options.json);
  // A folder is one word: what follows is the scene.
  EXPECT_EQ(read_scene_options("--data x a.toml").scene, "a.toml");
  EXPECT_THROW(read_scene_options("--threads 4097"), Error);
  EXPECT_THROW(read_scene_options("--memory -1"), Error);
}

TEST(SceneOptions, WithoutASceneItIsTheDemo) {
  SceneOptions options;
  options.files.settings = {"output.width=321"};
  const LoadedScene scene = load(options);
  EXPECT_EQ(scene.name, "demo");
  EXPECT_EQ(scene.scene.output.width, 321);
  options.scene = "/nowhere/a.toml";
  EXPECT_EQ(test::error_of([&] { load(options); }).kind(), ErrorKind::input);
}

}  // namespace
}  // namespace belvedere::tools
