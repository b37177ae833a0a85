#include "renderer/world/ground_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace belvedere {
namespace {

using testing::HasSubstr;

// 8192 × 8192 cells of 30 m on level ground, an eye 3 km above its southern edge.
const RasterFrame frame{{0.0, 245760.0, 30.0, 30.0}, 8192, 8192, {}};

Dem level_ground(int halved) {
  const int side = 8192 >> halved;
  const double cell = std::ldexp(30.0, halved);
  Dem dem = make_dem({Grid<float>(side, side, 0.F),
                      {0.5 * (30.0 - cell), 245760.0 - 0.5 * (30.0 - cell), cell, cell},
                      {}});
  dem.halved = halved;
  return dem;
}

View view(int width) {
  View view;
  view.camera.width = width;
  view.camera.height = width / 2;
  view.camera.eye = {122880.0, 3000.0, 3000.0};
  view.camera.pitch_deg = -8;
  view.viewer_xy = {122880.0, 3000.0};
  return view;
}

double cells_of(const GroundPlan& plan) {
  double cells = std::pow(8192 >> plan.coarsest, 2);
  for (const GroundWindow& window : plan.windows)
    cells += static_cast<double>(window.part.width()) * window.part.height();
  return cells;
}

TEST(GroundPlan, WindowsNestOnCellsThatBothHave) {
  const GroundPlan plan = plan_ground(frame, level_ground(3), view(4000), 6e6);
  ASSERT_GE(plan.windows.size(), 2U);
  PixelRect before{0, 0, 1024, 1024};
  int level = 3;
  for (const GroundWindow& window : plan.windows) {
    EXPECT_EQ(window.level, --level);
    EXPECT_EQ(window.part.x0 % 2, 0);
    EXPECT_EQ(window.part.y0 % 2, 0);
    EXPECT_EQ(window.part.width() % 2, 1);
    EXPECT_EQ(window.part.height() % 2, 1);
    EXPECT_GE(window.part.x0, 2 * before.x0 + 16);
    EXPECT_LE(window.part.y1, 2 * before.y1 - 16);
    before = window.part;
  }
  EXPECT_LE(cells_of(plan), 6e6);
}

TEST(GroundPlan, WiderPicturesGetFinerGroundFartherOff) {
  // A pixel of 100 shows twice as much ground as one of 200.
  const GroundPlan small = plan_ground(frame, level_ground(3), view(100), 3e7);
  const GroundPlan large = plan_ground(frame, level_ground(3), view(200), 3e7);
  ASSERT_FALSE(small.windows.empty());
  ASSERT_FALSE(large.windows.empty());
  EXPECT_GT(large.windows.back().to_m, 1.5 * small.windows.back().to_m);
  EXPECT_DOUBLE_EQ(small.cells_per_pixel, 0.25) << "nothing is saved where all is had";
}

TEST(GroundPlan, LessMemoryMeansCoarserCells) {
  const GroundPlan little = plan_ground(frame, level_ground(3), view(4000), 4.5e6);
  const GroundPlan much = plan_ground(frame, level_ground(3), view(4000), 1.6e7);
  EXPECT_GT(little.cells_per_pixel, much.cells_per_pixel);
  EXPECT_LE(cells_of(little), 4.5e6);
}

TEST(GroundPlan, SaysWhatIsCoarser) {
  const std::string text = describe({3, {{2, {}, 90000.0}, {1, {}, 40000.0}}, 1.0}, frame);
  EXPECT_THAT(text, HasSubstr("8192 × 8192"));
  EXPECT_THAT(text, HasSubstr("60 m to 40 km, 120 m to 90 km, 240 m beyond"));
}

}  // namespace
}  // namespace belvedere
