#include "renderer/stages/sheet_ice.h"

#include <gtest/gtest.h>

#include <fmt/core.h>

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

}  // namespace
}  // namespace belvedere
