#include "renderer/stages/ground_inputs.h"

#include <gtest/gtest.h>

#include "renderer/stages/lit_picture.h"
#include "renderer/stages/stages.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

// Before there is a world the stages have the same reaches as afterwards, so that memory is known
// beforehand.
TEST(GroundInputs, AnEstimateHasTheReachesOfTheWorlds) {
  const LoadedScene scene =
      test::small_scene({"output.width=400", "output.height=200", "land_cover.rock=granite"});
  const World world = make_world(scene, silent_progress());
  const Palette palette = read_palette("summer");
  TileStore::Place nowhere;
  StageGraph made(nowhere, silent_progress());
  StageGraph estimated(nowhere, silent_progress());
  const auto add = [](StageGraph& graph, GroundInputs inputs) {
    const GroundStages ground = add_ground_stages(graph, std::move(inputs), 256);
    return add_picture_stages(graph, ground, nullptr).picture->bytes_to_make(256);
  };
  const double bytes = add(made, make_ground_inputs(world, view_of(world), palette, {}));
  EXPECT_EQ(add(estimated, estimate_ground_inputs(scene.scene, scene.scene.pixels_per_unit())),
            bytes);
  EXPECT_GT(bytes, 400.0 * 200.0 * 60.0);
  EXPECT_EQ(estimated.draw(4.0), made.draw(4.0));
}

}  // namespace
}  // namespace belvedere
