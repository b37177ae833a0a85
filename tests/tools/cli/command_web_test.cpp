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
  ASSERT_THAT(run({"web", path("out")}), Prints(HasSubstr("out/web/index.html")));
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
  EXPECT_THAT(run({"web", path("none")}),
              Ends(3, HasSubstr("a folder written by belvedere render")));
}

}  // namespace
}  // namespace belvedere
