// `belvedere web` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/tools/program.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST_F(Program, ARenderedFolderBecomesAPage) {
  const std::string scene = write_scene_file();
  ASSERT_EQ(run({"render", scene, "-q", "--out", path("out")}).status, 0);
  const Outcome made = run({"web", path("out")});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("out/web/index.html"));
  EXPECT_THAT(read_bytes(path("out/web/panorama.js")), HasSubstr("\"distances\""));
  EXPECT_THAT(read_bytes(path("out/web/index.html")), HasSubstr("Belvedere"));
  const Outcome again = run({"web", path("out"), "--name", "Summer", "--also",
                             path("out") + "=Winter", "--out", path("page"), "-q"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_THAT(read_bytes(path("page/panorama.js")), HasSubstr("\"Winter\""));
}

TEST_F(Program, APageOfNothingIsRefused) {
  fs::create_directories(path("empty"));
  EXPECT_EQ(run({"web", path("empty")}).status, 3);
  const Outcome none = run({"web", path("none")});
  EXPECT_EQ(none.status, 3);
  EXPECT_THAT(none.err, HasSubstr("a folder written by belvedere render"));
}

}  // namespace
}  // namespace belvedere
