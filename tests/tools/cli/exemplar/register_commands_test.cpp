#include "tools/cli/exemplar/register_commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/scene/scene_file.h"

namespace belvedere::tools {
namespace {

TEST(RegisteredSceneText, HasTheViewTheLightAndThePaintersLines) {
  Scene scene;
  scene.camera.position = glm::dvec2(1000.0, 2000.0);
  scene.sun.azimuth_deg = 290.0;
  scene.land_cover.settings = {{"treeline_m", 1650.0}, {"snowline_m", 2500.0}};
  const std::string text = registered_scene_text(scene);
  const Scene again = parse_scene(text, "registered.toml", ".", {}).scene;
  EXPECT_EQ(again.camera.position, scene.camera.position);
  EXPECT_EQ(again.sun.azimuth_deg, scene.sun.azimuth_deg);
  EXPECT_EQ(again.land_cover.settings, scene.land_cover.settings);
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("[synthesis]")));
}

TEST(RegisteredSceneText, HasNoLinesThatThePaintDoesNotTell) {
  Scene scene;
  scene.camera.position = glm::dvec2(1000.0, 2000.0);
  EXPECT_THAT(registered_scene_text(scene), testing::Not(testing::HasSubstr("land_cover")));
}

}  // namespace
}  // namespace belvedere::tools
