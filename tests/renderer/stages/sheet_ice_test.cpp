#include "renderer/stages/sheet_ice.h"

#include <gtest/gtest.h>

#include <fmt/core.h>

#include <algorithm>

#include "renderer/world/picture_parameters.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

// High mountains on a sheet of 115 × 105 mm, with glaciers above the line.
IcePlan plan_at(int width, int ice_line_m) {
  const World world = make_world(
      test::small_scene({fmt::format("output.width={}", width),
                         fmt::format("output.height={}", width * 105 / 115),
                         "output.sheet_width_mm=115", "terrain.synthetic.highest_m=3900",
                         fmt::format("land_cover.settings.ice_line_m={}", ice_line_m),
                         "land_cover.settings.treeline_m=400",
                         fmt::format("land_cover.settings.snowline_m={}", ice_line_m + 200)}),
      silent_progress());
  return make_ice_plan(world, {});
}

TEST(SheetIce, IsNoneWhereNoIceIs) {
  const IcePlan plan = plan_at(230, 9000);
  EXPECT_TRUE(plan.flow.direction.empty());
  EXPECT_TRUE(plan.ways.empty());
}

// On a sheet with four times the pixels it is the same, from the same trace.
TEST(SheetIce, IsThatOfThePaperNotOfThePixels) {
  const IcePlan small =
      plan_at(230, 1300);  // with bare ground beside the ice: firn alone has hardly any
  const IcePlan large = plan_at(920, 1300);
  EXPECT_GT(small.ways.size(), 5U);
  ASSERT_EQ(small.ways.size(), large.ways.size());
  EXPECT_TRUE(small.flow.direction == large.flow.direction);
  for (std::size_t i = 0; i < small.ways.size(); ++i)
    EXPECT_EQ(small.ways[i].positions, large.ways[i].positions);
}

// Rows are traced some at a time; the plan is that of all rows together, up to the edges of the
// sheet. The camera looks down, so that ice lies at the upper edge too.
TEST(SheetIce, IsThatOfAllRowsTracedAtOnce) {
  const World world =
      make_world(test::small_scene(
                     {"output.width=120", "output.height=280", "output.sheet_width_mm=60",
                      "camera.pitch_deg=-80", "terrain.synthetic.highest_m=3900",
                      "land_cover.settings.ice_line_m=1150", "land_cover.settings.treeline_m=400",
                      "land_cover.settings.snowline_m=1500"}),
                 silent_progress());
  const glm::ivec2 size = world.camera->size();
  const GuidanceBuffers seen = trace_forms(world, *world.camera, {0, 0, size.x, size.y}, {});
  StrokeParameters parameters;
  parameters.pixels_per_unit = world.scene.pixels_per_unit();
  parameters.seed = world.scene.seed;
  const IcePlan whole = plan_ice(seen, parameters);
  const auto is_ice = [](LandCoverClass id) { return has_trait(id, ClassTrait::icy); };
  ASSERT_TRUE(std::any_of(seen.land_cover.row(0), seen.land_cover.row(0) + size.x, is_ice));
  ASSERT_GT(whole.ways.size(), 2U);
  const IcePlan plan = make_ice_plan(world, {});
  EXPECT_TRUE(plan.flow.direction == whole.flow.direction);
  ASSERT_EQ(plan.ways.size(), whole.ways.size());
  for (std::size_t i = 0; i < plan.ways.size(); ++i)
    EXPECT_EQ(plan.ways[i].positions, whole.ways[i].positions);
}

}  // namespace
}  // namespace belvedere
