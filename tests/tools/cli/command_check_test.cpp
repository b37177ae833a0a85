// `belvedere check` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(Program, CameraUnderGroundIsAUsageError) {
  const Outcome outcome = run({"check", write_scene_file(), "--set", "camera.position=[9000, 9000]", "--set", "camera.height_m=-900"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("camera.height_m"), HasSubstr("below the ground")));
}

TEST_F(Program, CheckReportsWhatItSaw) {
  const Outcome outcome = run({"check", write_scene_file(), "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("\"valid\": true"), HasSubstr("\"cell_m\": 200"), HasSubstr("\"classes\": {")));
}

TEST_F(Program, CheckSaysWhatBecameOfSmallPatches) {
  const std::string scene = write_scene_file("[land_cover]\nsmallest_patch_m2 = 1e6\n");
  const Outcome words = run({"check", scene});
  ASSERT_EQ(words.status, 0) << words.err;
  EXPECT_THAT(words.out, AllOf(HasSubstr("land cover: "), HasSubstr("before small ones were taken out")));
  EXPECT_THAT(run({"check", scene, "--json"}).out, HasSubstr("\"patches_before\": "));
  EXPECT_THAT(run({"check", write_scene_file()}).out, Not(HasSubstr("land cover: ")));
}

}  // namespace
}  // namespace belvedere
