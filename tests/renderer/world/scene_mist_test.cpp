#include "renderer/world/scene_mist.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "renderer/world/world.h"
#include "tests/files.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

TEST(SceneMist, AScenesMistIsNoneWhereItAsksForNone) {
  const World world = make_world(test::small_scene(), silent_progress());
  EXPECT_TRUE(world.mist.empty());
}

TEST(SceneMist, IsWhatTheSceneSays) {
  const World world = make_world(
      test::small_scene({"air.mist.0={ kind = \"sea\", to_m = 900, visibility_m = 222 }",
                         "air.mist.1={ kind = \"valley\" }",
                         "air.mist.2={ kind = \"lee\", position = [6000, 6000], size_m = 1500 }"}),
      silent_progress());
  ASSERT_EQ(world.mist.layers.size(), 2U);
  EXPECT_EQ(world.mist.layers[0].kind, MistKind::sea);
  EXPECT_EQ(world.mist.layers[0].to_m, 900.0);
  EXPECT_EQ(world.mist.layers[0].visibility_m, 222.0);
  EXPECT_EQ(world.mist.layers[1].kind, MistKind::valley);
  EXPECT_EQ(world.mist.layers[1].patches, 0.35);
  EXPECT_FALSE(world.mist.ground.floor_m.empty());
  ASSERT_EQ(world.mist.clouds.size(), 1U);
  EXPECT_EQ(world.mist.rim_fade_m, 4000.0);
  EXPECT_GT(world.mist.farthest_m, 16000.0) << "the northern corners";
}

TEST(SceneMist, WhatIsMissingIsNamed) {
  const auto message = [](const char* mist) {
    return test::message_of(ErrorKind::usage,
                            [&] { test::small_scene({std::string("air.mist.0=") + mist}); });
  };
  EXPECT_THAT(message("{ kind = \"sea\" }"), HasSubstr("to_m"));
  EXPECT_THAT(message("{ kind = \"lee\" }"), HasSubstr("position"));
  EXPECT_THAT(message("{ kind = \"valley\", radius_m = 900 }"), HasSubstr("position"));
  EXPECT_THAT(message("{ kind = \"smoke\" }"), HasSubstr("lee"));
}

}  // namespace
}  // namespace belvedere
