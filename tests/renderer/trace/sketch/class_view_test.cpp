#include "renderer/trace/sketch/class_view.h"

#include <gtest/gtest.h>

#include <set>

#include "renderer/world/world.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

TEST(ClassView, IsTheClassThatOneSampleSees) {
  // Valleys are widened, so that ground is drawn elsewhere than its classes; a width that is not a
  // multiple of a bundle.
  for (const char* setting : {"generalize.widen_valleys_m=0", "generalize.widen_valleys_m=900"}) {
    const World world =
        make_world(test::small_scene({setting, "output.width=93"}), silent_progress());
    const GuidanceBuffers guidance =
        trace_guidance(world.terrain, *world.surface, world.tracer, *world.camera,
                       {.sampling = world.scene.sampling}, {0, 0, 93, 80}, silent_progress());
    TerrainModel bare;
    bare.dem = world.dem;
    bare.generalized_m = world.terrain.generalized_m;
    bare.came_from = world.terrain.came_from;
    bare.goes_to = world.terrain.goes_to;
    bare.land_cover = world.land_cover;
    const Grid<LandCoverClass> seen = trace_classes(bare, world.tracer, *world.camera);
    EXPECT_EQ(seen, guidance.land_cover) << setting;
    EXPECT_GT(std::set<LandCoverClass>(seen.begin(), seen.end()).size(), 3U);
  }
}

}  // namespace
}  // namespace belvedere
