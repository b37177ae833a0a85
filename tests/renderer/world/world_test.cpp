#include "renderer/world/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "renderer/world/scene_dem.h"
#include "renderer/world/scene_land_cover.h"
#include "tests/files.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

using test::small_scene;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Stages : Progress {
  void begin(std::string_view stage, double) override { all.emplace_back(stage); }
  std::vector<std::string> all;
};

TEST(World, IsMadeInOrder) {
  Stages stages;
  const World world = make_world(small_scene(), stages);
  EXPECT_THAT(stages.all, ElementsAre("synthetic terrain", "class rules", "generalize",
                                      "building the ray tracer"));
}

TEST(World, ItsValuesFitEachOther) {
  const World world = make_world(small_scene(), silent_progress());
  EXPECT_EQ(world.camera->size(), glm::ivec2(96, 80));
  EXPECT_EQ(world.camera->eye(), world.view.camera.eye);
  EXPECT_EQ(world.terrain.dem, world.dem);
  EXPECT_EQ(world.terrain.land_cover, world.land_cover);
  EXPECT_TRUE(world.terrain.generalized_m.same_size(world.dem->altitude_m));
  EXPECT_FALSE(world.terrain.local.has_value()) << "nothing is rearranged";
  // Hills reach into the sky: the skyline is in the picture, and above its centre.
  EXPECT_GT(world.horizon_px, 0.0);
  EXPECT_LT(world.horizon_px, 40.0);
}

TEST(World, APictureWithoutTerrainIsRefused) {
  EXPECT_THAT(
      test::message_of(ErrorKind::usage,
                       [] { make_world(small_scene({"camera.pitch_deg=60"}), silent_progress()); }),
      HasSubstr("no ground is in the picture"));
}

TEST(World, SharesTheTerrainThatIsThere) {
  const LoadedScene loaded = small_scene();
  const auto dem = std::make_shared<const Dem>(make_scene_dem(loaded, silent_progress()));
  const auto cover =
      std::make_shared<const LandCover>(make_scene_land_cover(loaded, *dem, silent_progress()));
  Stages stages;
  const World world = make_world(loaded, stages, no_cache(), {dem, cover});
  EXPECT_EQ(world.dem, dem);
  EXPECT_EQ(world.land_cover, cover);
  EXPECT_THAT(stages.all, ElementsAre("generalize", "building the ray tracer"));
  EXPECT_EQ(world.terrain.generalized_m,
            make_world(loaded, silent_progress()).terrain.generalized_m);
}

// ---- refused as early as possible

constexpr const char* no_files = R"(version = 1
[[terrain.sources]]
file = "none.tif"
[camera]
position = [0, 0]
)";

TEST(World, RefusesAMachineThatCannotBeforeItReadsAnything) {
  const char* old = std::getenv("BELVEDERE_INSTRUCTION_SET");
  const std::string kept = old == nullptr ? "" : old;
  setenv("BELVEDERE_INSTRUCTION_SET", "sse4.2", 1);
  Stages stages;
  EXPECT_THAT(test::message_of(ErrorKind::limit,
                               [&] {
                                 const World world = make_world(
                                     parse_scene(no_files, "s.toml", ".",
                                                 {.data_folders = {},
                                                  .settings = {"sampling.instruction_set=avx2"}}),
                                     stages);
                               }),
              HasSubstr("sampling.instruction_set"));
  if (old == nullptr)
    unsetenv("BELVEDERE_INSTRUCTION_SET");
  else
    setenv("BELVEDERE_INSTRUCTION_SET", kept.c_str(), 1);
  EXPECT_THAT(stages.all, IsEmpty());
}

TEST(World, RefusesAnEyeBelowTheGroundBeforeLandCoverIsMade) {
  Stages stages;
  EXPECT_THAT(
      test::message_of(ErrorKind::usage,
                       [&] {
                         const World world = make_world(
                             small_scene({"camera.position=[6000,6000]", "camera.height_m=-500"}),
                             stages);
                       }),
      HasSubstr("below the ground"));
  EXPECT_THAT(stages.all, ElementsAre("synthetic terrain"));
}

TEST(World, RefusesFoldedGroundBeforeTheTracerIsBuilt) {
  Stages stages;
  EXPECT_THAT(
      test::message_of(
          ErrorKind::usage,
          [&] {
            const World world = make_world(
                small_scene(
                    {"camera.position=[6000,6000]", "camera.height_m=12000", "camera.pitch_deg=-90",
                     "camera.field_of_view_deg=90",
                     "deform.handles.0={ position = [6000, 6000], radius_m = 3000, core_m = "
                     "1000, move_m = [2500, 0] }"}),
                stages);
          }),
      HasSubstr("folds"));
  EXPECT_THAT(stages.all, ElementsAre("synthetic terrain", "class rules", "generalize"));
}

}  // namespace
}  // namespace belvedere
