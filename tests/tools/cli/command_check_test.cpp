// `belvedere check` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(Program, CameraUnderGroundIsAUsageError) {
  EXPECT_THAT(run({"check", write_scene_file(), "--set", "camera.position=[9000, 9000]", "--set",
                   "camera.height_m=-900"}),
              Ends(2, AllOf(HasSubstr("camera.height_m"), HasSubstr("below the ground"))));
}

TEST_F(Program, CheckReportsWhatItSaw) {
  ASSERT_THAT(run({"check", write_scene_file(), "--json"}),
              Prints(AllOf(HasSubstr("\"valid\": true"), HasSubstr("\"cell_m\": 200"),
                           HasSubstr("\"classes\": {"))));
}

TEST_F(Program, CheckSaysWhatBecameOfSmallPatches) {
  const std::string scene = write_scene_file("[land_cover]\nsmallest_patch_m2 = 1e6\n");
  ASSERT_THAT(run({"check", scene}), Prints(AllOf(HasSubstr("land cover: "),
                                                  HasSubstr("before small ones were removed"))));
  EXPECT_THAT(run({"check", scene, "--json"}).out, HasSubstr("\"patches_before\": "));
  EXPECT_THAT(run({"check", write_scene_file()}).out, Not(HasSubstr("land cover: ")));
}

// The mountains are seen from the south, so a sun in the north leaves them in shade.
TEST_F(Program, CheckProposesLightThatLoads) {
  const std::string dark = write_scene_file("[sun]\nazimuth_deg = 0\naltitude_deg = 20\n");
  EXPECT_THAT(run({"check", dark}).out,
              AllOf(HasSubstr("light on the main ranges:"), HasSubstr("; in shade"),
                    HasSubstr("belvedere check --propose-light")));
  const auto ranges_in_shade = [](const std::string& json) {
    const std::string shade = "\"in_shade\": true";
    int count = 0;
    for (std::size_t at = json.find(shade); at != std::string::npos; at = json.find(shade, at + 1))
      ++count;
    return count;
  };
  const int in_shade = ranges_in_shade(run({"check", dark, "--json"}).out);
  const Outcome proposed = run({"check", dark, "--propose-light"});
  ASSERT_EQ(proposed.status, 0) << proposed.err;
  EXPECT_THAT(proposed.out, AllOf(HasSubstr("[[light.regions]]\n"), HasSubstr("turn_deg = "),
                                  Not(HasSubstr("is valid"))));
  std::ofstream(dark, std::ios::app) << proposed.out;  // as the command's help says
  const Outcome after = run({"check", dark, "--json"});
  ASSERT_EQ(after.status, 0) << after.err;
  EXPECT_LE(ranges_in_shade(after.out) + 2, in_shade);

  ASSERT_THAT(run({"check", write_scene_file("[sun]\nazimuth_deg = 200\naltitude_deg = 40\n"),
                   "--propose-light"}),
              Prints(AllOf(HasSubstr("# No range"), Not(HasSubstr("[[")))));
}

TEST_F(Program, CheckNotesTheFileOfALightRegionThatIsMissing) {
  const std::string block = "[[light.regions]]\nfile = \"nowhere.gpkg\"\nturn_deg = 40\n";
  const Outcome noted = run({"check", write_scene_file(block + "optional = true\n")});
  EXPECT_EQ(noted.status, 0) << noted.err;
  EXPECT_THAT(noted.out, HasSubstr("left out: nowhere.gpkg"));
  EXPECT_THAT(noted.err, HasSubstr("light.regions.0 is left out: nowhere.gpkg is missing"));
  EXPECT_NE(run({"check", write_scene_file(block)}).status, 0);
}

}  // namespace
}  // namespace belvedere
