#include "tools/cli/deform_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/files.h"

namespace belvedere::tools {
namespace {

using ::testing::HasSubstr;

std::string refusal(const DeformOptions& options) {
  return test::usage_error([&] { load(options); });
}

TEST(DeformOptions, PairsAreTwoNumbersInAnyLocale) {
  EXPECT_EQ(parse_pair("692000.5,-5302000", "--viewer"), glm::dvec2(692000.5, -5302000.0));
  for (const char* text : {"", "1", "1,2,3", "1,x", "1;2", "1, 2"})
    EXPECT_THAT(test::usage_error([&] { parse_pair(text, "--viewer"); }), HasSubstr("--viewer"))
        << text;
}

TEST(DeformOptions, ASceneEndsInToml) {
  DeformOptions options;
  EXPECT_TRUE(is_scene(options));
  options.scene.scene = "a.toml";
  EXPECT_TRUE(is_scene(options));
  options.scene.scene = "a.tif";
  EXPECT_FALSE(is_scene(options));
}

TEST(DeformOptions, BecomeSettingsOfTheScene) {
  DeformOptions options;  // of the demo
  options.exaggeration = "1.5";
  options.bend = "10000:25,40000:12,80000:0";
  options.handles = {"1000,2000 radius=6000 core=2000 rotate=50 move=500,-10 scale=1.1 raise=100",
                     "5,6 radius=100"};
  options.viewer = "3000,-9000";
  options.scene.files.settings = {"deform.exaggeration=2"};
  const LoadedScene loaded = load(options);
  const DeformParameters ground = loaded.scene.deform.written();
  EXPECT_EQ(ground.exaggeration, 2.0) << "--set has the last word";
  ASSERT_EQ(ground.bend.points.size(), 3U);
  EXPECT_EQ(ground.bend.points[1].distance_m, 40000.0);
  EXPECT_EQ(*ground.bend.points[1].inclination_deg, 12.0);
  const auto& handles = loaded.scene.deform.handles;
  ASSERT_EQ(handles.size(), 2U);
  EXPECT_EQ(handles[0].handle.radius_m, 6000.0);
  EXPECT_EQ(handles[0].handle.rotate_deg, 50.0);
  EXPECT_EQ(handles[0].handle.raise_m, 100.0);
  EXPECT_EQ(handles[1].handle.radius_m, 100.0);
  ASSERT_TRUE(loaded.scene.camera.position);
  EXPECT_EQ(*loaded.scene.camera.position, glm::dvec2(3000.0, -9000.0));
}

TEST(DeformOptions, OfADemMakeASceneThatHoldsItAlone) {
  DeformOptions options;
  options.scene.scene = "some/where/my \"dem\".tif";
  options.exaggeration = "2";
  const LoadedScene loaded = load(options);
  EXPECT_EQ(loaded.scene.deform.exaggeration, 2.0);
  ASSERT_TRUE(loaded.scene.camera.position) << "without distances no viewer is needed";
  options.bend = "1000:10,9000:0";
  EXPECT_THAT(refusal(options), HasSubstr("--viewer E,N"));
  options.viewer = "1,2";
  EXPECT_EQ(load(options).scene.deform.ground.bend.points.size(), 2U);
}

TEST(DeformOptions, MistakesAreNamed) {
  DeformOptions options;
  options.bend = "10000-25";
  EXPECT_THAT(refusal(options), HasSubstr("\"10000-25\""));
  options.bend = "";
  for (const char* handle : {"", "1,2 spin=3", "1,2 radius", "1 radius=2", "1,2 move=5"}) {
    options.handles = {handle};
    EXPECT_THAT(refusal(options), HasSubstr("--handle")) << handle;
  }
  options.handles.clear();
  options.exaggeration = "much";
  EXPECT_THAT(refusal(options), HasSubstr("\"much\""));
}

}  // namespace
}  // namespace belvedere::tools
