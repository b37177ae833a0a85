#include "base/grid_part.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

// Each value encodes its position; high enough that several threads share the rows.
Grid<int> numbered(int width, int height) {
  Grid<int> grid(width, height);
  for (int i = 0; i < width * height; ++i) grid[static_cast<std::size_t>(i)] = i;
  return grid;
}

TEST(GridPart, APartHasTheValuesOfItsRectangle) {
  const Grid<int> whole = numbered(7, 200);
  const Grid<int> part = part_of(whole, {2, 30, 6, 195});
  ASSERT_EQ(part.width(), 4);
  ASSERT_EQ(part.height(), 165);
  for (int y = 0; y < part.height(); ++y)
    for (int x = 0; x < part.width(); ++x)
      ASSERT_EQ(part(x, y), (y + 30) * 7 + x + 2) << x << ", " << y;
}

TEST(GridPart, CopyingAPartBackChangesItsRectangleAlone) {
  const Grid<int> whole = numbered(7, 200);
  const PixelRect rect{2, 30, 6, 195};
  Grid<int> blank(7, 200, -1);
  copy_part(blank, part_of(whole, rect), rect.x0, rect.y0);
  for (int y = 0; y < whole.height(); ++y)
    for (int x = 0; x < whole.width(); ++x) {
      const bool inside = x >= rect.x0 && x < rect.x1 && y >= rect.y0 && y < rect.y1;
      ASSERT_EQ(blank(x, y), inside ? whole(x, y) : -1) << x << ", " << y;
    }
}

TEST(GridPart, AnEmptyPartIsNothing) {
  EXPECT_TRUE(part_of(numbered(7, 9), {3, 4, 3, 9}).empty());
  Grid<int> whole = numbered(7, 9);
  copy_part(whole, Grid<int>(), 3, 4);
  EXPECT_EQ(whole, numbered(7, 9));
}

}  // namespace
}  // namespace belvedere
