// `belvedere cache` and --no-cache as users meet them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class CacheProgram : public Program {
 protected:
  Outcome run_with_cache(const std::vector<std::string>& arguments) const {
    return run(arguments, {"BELVEDERE_CACHE=" + path("cache")});
  }
};

TEST_F(CacheProgram, SecondRunsAreTheSameWithoutTheSlowStages) {
  const std::string scene = write_scene_file("title = \"Test hills\"\n");
  const Outcome none = run_with_cache({"guidance", scene, "--out", path("none"), "--no-cache"});
  ASSERT_EQ(none.status, 0) << none.err;
  EXPECT_THAT(run_with_cache({"cache", "list"}).out, HasSubstr("0 entries"));
  const Outcome cold = run_with_cache({"guidance", scene, "--out", path("cold")});
  const Outcome warm = run_with_cache({"guidance", scene, "--out", path("warm")});
  EXPECT_THAT(cold.err, HasSubstr("class rules"));
  EXPECT_THAT(warm.err, Not(HasSubstr("class rules")));
  for (const char* name : {"cold/guidance.exr", "warm/guidance.exr"})
    EXPECT_EQ(read_bytes(path(name)), read_bytes(path("none/guidance.exr"))) << name;
  // A check fills the cache for rendering, and vice versa.
  EXPECT_THAT(run_with_cache({"check", scene}).err,
              AllOf(Not(HasSubstr("class rules")), Not(HasSubstr("generalize"))));
  EXPECT_THAT(run_with_cache({"check", scene, "--no-cache"}).err, HasSubstr("class rules"));
}

TEST_F(CacheProgram, IsListedAndCleared) {
  const std::string scene = write_scene_file("title = \"Test hills\"\n");
  ASSERT_EQ(run_with_cache({"check", scene}).status, 0);
  const Outcome list = run_with_cache({"cache", "list"});
  EXPECT_EQ(list.status, 0);
  EXPECT_THAT(list.out,
              AllOf(HasSubstr("land cover by rules"), HasSubstr("generalized ground"),
                    HasSubstr("Test hills"), HasSubstr("3 entries"), HasSubstr(path("cache"))));
  EXPECT_THAT(run_with_cache({"cache", "list", "--json"}).out,
              AllOf(HasSubstr("\"product\": \"synthetic terrain\""), HasSubstr("\"unused_s\": ")));
  EXPECT_THAT(run_with_cache({"cache", "clear", "--older-than", "1"}).out,
              HasSubstr("removed 0 entries"));
  EXPECT_THAT(run_with_cache({"cache", "clear"}).out, HasSubstr("removed 3 entries"));
  EXPECT_THAT(run_with_cache({"cache", "list"}).out, HasSubstr("0 entries"));
  EXPECT_EQ(run_with_cache({"cache", "clear", "--older-than", "-1"}).status, 2);
}

TEST_F(CacheProgram, WithoutAFolderWorkGoesOn) {
  const std::string scene = write_scene_file();
  EXPECT_THAT(run({"check", scene}, {"BELVEDERE_CACHE=" + write("file", "") + "/cache"}),
              Ends(0, HasSubstr("not used")));
  EXPECT_THAT(run({"check", scene}, without_cache()), Ends(0, Not(HasSubstr("cache"))));
  EXPECT_EQ(run({"cache", "list"}, without_cache()).status, 2);
}

// The standard of desktops: XDG_CACHE_HOME where it is an absolute path, else .cache at home.
TEST_F(CacheProgram, LiesWhereCachesLie) {
  const std::string home = path("home");
  const auto folder = [&](const std::string& xdg) {
    return run({"cache", "list"}, {"BELVEDERE_CACHE", "HOME=" + home, "XDG_CACHE_HOME=" + xdg})
        .out;  // the first one is taken away
  };
  EXPECT_THAT(folder(path("xdg")), HasSubstr(path("xdg/belvedere")));
  EXPECT_THAT(folder("relative"), HasSubstr(home + "/.cache/belvedere"));
}

}  // namespace
}  // namespace belvedere
