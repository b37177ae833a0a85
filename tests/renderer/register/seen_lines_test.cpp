#include "renderer/register/seen_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr float no_ground = std::numeric_limits<float>::quiet_NaN();

// Sky above row 10, far ground below, near ground below a ridge that rises by a row in two columns.
RegisteredGround two_ranges(int width) {
  RegisteredGround out;
  out.distance_m = test::grid_of(width, 60, [](int x, int y) {
    return y < 10 ? static_cast<double>(no_ground) : y < 50 - x / 2 ? 20000.0 : 8000.0;
  });
  return out;
}

TEST(SeenLines, AreTheSkylineAndTheRidge) {
  const std::vector<SeenLine> lines = seen_lines(two_ranges(40));
  ASSERT_EQ(lines.size(), 2U);
  for (const SeenLine& line : lines) {
    ASSERT_EQ(line.points.size(), 40U);
    for (int x = 0; x < 40; ++x) {
      const glm::vec2 point = line.points[static_cast<std::size_t>(x)];
      EXPECT_EQ(point.x, static_cast<float>(x) + 0.5F);
      EXPECT_EQ(point.y, line.skyline ? 10.F : static_cast<float>(50 - x / 2));
    }
  }
  EXPECT_NE(lines[0].skyline, lines[1].skyline);
}

TEST(SeenLines, SlopesAndShortPiecesAreNone) {
  RegisteredGround slope;
  slope.distance_m = test::grid_of(40, 60, [](int, int y) { return 9000.0 - 100.0 * y; });
  EXPECT_TRUE(seen_lines(slope).empty());
  EXPECT_TRUE(seen_lines(two_ranges(7)).empty());
  EXPECT_EQ(seen_lines(two_ranges(7), {.min_length_px = 7}).size(), 2U);
}

TEST(SeenLines, AStepOfMoreThanItsLimitEndsALineAndBeginsAnother) {
  const auto stepped = [](int rows) {
    RegisteredGround out;
    out.distance_m = test::grid_of(40, 60, [=](int x, int y) {
      return y < (x < 20 ? 10 : 10 + rows) ? static_cast<double>(no_ground) : 5000.0;
    });
    return out;
  };
  const SeenLinesParameters usual;
  EXPECT_EQ(seen_lines(stepped(usual.max_step_px)).size(), 1U);
  const std::vector<SeenLine> lines = seen_lines(stepped(usual.max_step_px + 1));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].points.back().x, 19.5F);
  EXPECT_EQ(lines[1].points.front().x, 20.5F);
}

}  // namespace
}  // namespace belvedere
