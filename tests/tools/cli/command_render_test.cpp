// `belvedere render` and `guidance` as users meet them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/tools/program.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

TEST_F(Program, GuidanceIsWrittenAndTold) {
  const std::string scene = write_scene_file("title = \"Test hills\"\n");
  const Outcome outcome =
      run({"guidance", scene, "--out", path("result"), "--json", "--threads", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("\"width\": 96"), HasSubstr("guidance.exr"),
                                 HasSubstr("\"bytes\": ")));
  // No terminal: one line a stage, nothing drawn over.
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("s)\n"), Not(HasSubstr("\r")), Not(HasSubstr("\033"))));

  const Outcome info = run({"info", path("result/guidance.exr")});
  EXPECT_EQ(info.status, 0);
  EXPECT_THAT(info.out, AllOf(HasSubstr("96 × 64 pixels"), HasSubstr("landcover.id (uint)"),
                              HasSubstr("belvedere:version"), HasSubstr("Test hills")));
  EXPECT_THAT(run({"info", path("result/guidance.exr"), "--json"}).out,
              AllOf(StartsWith("{\n"), HasSubstr("\"format\": \"openexr\"")));

  // The same from other threads and tiles, quietly.
  const Outcome again =
      run({"guidance", scene, "--out", path("again"), "--quiet", "--threads", "2", "--tile", "8"},
          without_cache());
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.err, IsEmpty());
  EXPECT_THAT(again.out, IsEmpty());
  EXPECT_EQ(read_bytes(path("again/guidance.exr")), read_bytes(path("result/guidance.exr")));
  EXPECT_THAT(run({"diff", path("again/guidance.exr"), path("result/guidance.exr")}), Ends(0));
}

TEST_F(Program, DraftIsRendered) {
  const std::string scene = write_scene_file("title = \"Test hills\"\n");
  const Outcome outcome =
      run({"render", scene, "--draft", "--out", path("draft"), "--json", "--set",
           "output.width=210", "--set", "output.height=195", "--set", "output.formats=[\"png\"]"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\"width\": 70"));
  EXPECT_THAT(outcome.out, HasSubstr("\"height\": 65"));
  EXPECT_THAT(run({"info", path("draft/guidance.exr")}).out, HasSubstr("70 × 65 pixels"));
}

TEST_F(Program, UnwritableFolderIsAnOutputError) {
  write("file", "in the way");
  EXPECT_THAT(run({"guidance", write_scene_file(), "--out", path("file/result")}),
              Ends(4, HasSubstr("file")));
}

TEST_F(Program, MissingFilesAreAllNamed) {
  const std::string scene = write(
      "missing.toml",
      "version = 1\n[[terrain.sources]]\nfile = \"a.tif\"\nget_from = \"https://example.org/a\"\n"
      "[[terrain.sources]]\nfile = \"b.tif\"\n[camera]\nposition = [0, 0]\n");
  for (const char* command : {"check", "render", "guidance"}) {
    const Outcome outcome = run({command, scene, "--out", path("result")});
    EXPECT_EQ(outcome.status, command == std::string("check") ? 2 : 3);  // check has no --out
    if (command == std::string("check")) continue;
    EXPECT_THAT(outcome.err,
                AllOf(HasSubstr("a.tif"), HasSubstr("b.tif"), HasSubstr("https://example.org/a")));
    EXPECT_FALSE(fs::exists(path("result")));
  }
  EXPECT_EQ(run({"check", scene}).status, 3);
  EXPECT_EQ(run({"check", path("nowhere.toml")}).status, 3);
}

}  // namespace
}  // namespace belvedere
