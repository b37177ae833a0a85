// `belvedere plan`, `part` and `join` as users meet them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/tools/program.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST_F(Program, APlannedSheetIsThatOfOneRun) {
  const std::string scene = write_scene_file("[[exemplar]]\nwidth = 240\nheight = 180\n");
  ASSERT_EQ(run({"render", scene, "-q", "--out", path("one")}).status, 0);
  ASSERT_THAT(run({"plan", scene, "--out", path("many"), "--parts", "2", "-q"}), Ends(0));
  const Outcome early = run({"join", path("many"), "-q"});
  EXPECT_EQ(early.status, 3);
  EXPECT_THAT(early.err, HasSubstr("missing"));
  EXPECT_THAT(early.err, HasSubstr("belvedere part " + path("many") + " 2"))
      << "which makes its one piece";
  // Another machine of a cluster has no cache.
  for (const char* part : {"2", "1", "1"})
    ASSERT_EQ(run({"part", path("many"), part, "-q"}, without_cache()).status, 0);
  ASSERT_EQ(run({"join", path("many"), "-q", "--out", path("joined")}).status, 0);
  for (const char* file : {"/panorama.tif", "/panorama.png", "/panorama.exr", "/guidance.exr"})
    EXPECT_TRUE(read_bytes(path("one") + file) == read_bytes(path("joined") + file)) << file;
}

// Given once: parts and the join of a plan take the layers from it.
TEST_F(Program, APlanKnowsItsLayers) {
  const std::string scene = write_scene_file();
  ASSERT_EQ(run({"plan", scene, "--out", path("many"), "--parts", "1", "-q", "--layers", "ora,exr"})
                .status,
            0);
  ASSERT_EQ(run({"part", path("many"), "1", "-q"}).status, 0);
  ASSERT_EQ(run({"join", path("many"), "-q"}).status, 0);
  EXPECT_TRUE(fs::exists(path("many/panorama.ora")));
  EXPECT_TRUE(fs::exists(path("many/panorama_layers.exr")));
  EXPECT_EQ(run({"plan", scene, "--out", path("other"), "--layers", "xcf"}).status, 2);
}

TEST_F(Program, PartsNeedAPlan) {
  fs::create_directories(path("empty"));
  for (const char* command : {"part", "join"}) {
    std::vector<std::string> line{command, path("empty")};
    if (command == std::string("part")) line.emplace_back("1");
    EXPECT_THAT(run(line), Ends(2, HasSubstr("belvedere plan")));
  }
}

TEST_F(Program, APartIsGivenAsFourNumbers) {
  const std::string scene = write_scene_file();
  EXPECT_EQ(run({"guidance", scene, "-q", "--part", "10,20,30,8", "--out", path("part")}).status,
            0);
  EXPECT_THAT(run({"info", path("part/guidance.exr")}).out, HasSubstr("30 × 8 pixels"));
  EXPECT_EQ(run({"guidance", scene, "-q", "--part", "10,20,30", "--out", path("part")}).status, 2);
  EXPECT_EQ(run({"guidance", scene, "-q", "--part", "90,20,30,8", "--out", path("part")}).status,
            2);
}

TEST_F(Program, AStoppedRunGoesOn) {
  const std::string scene = write_scene_file();
  fs::create_directories(path("out/.belvedere"));
  EXPECT_THAT(run({"guidance", scene, "-q", "--resume", "--out", path("out")}), Ends(0));
  EXPECT_FALSE(fs::exists(path("out/.belvedere")))
      << "nothing is left of a run that came to its end";
}

}  // namespace
}  // namespace belvedere
