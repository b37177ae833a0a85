#include "base/grid.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "tests/grids.h"

namespace belvedere {
namespace {

Grid<int> counted(int width, int height) {
  Grid<int> grid(width, height);
  std::iota(grid.begin(), grid.end(), 0);
  return grid;
}

TEST(Grid, IsRowMajor) {
  Grid<int> grid = counted(4, 3);
  EXPECT_EQ(grid.width(), 4);
  EXPECT_EQ(grid.height(), 3);
  EXPECT_EQ(grid.size(), 12U);
  EXPECT_EQ(grid(0, 0), 0);
  EXPECT_EQ(grid(3, 0), 3);
  EXPECT_EQ(grid(0, 1), 4);
  EXPECT_EQ(grid(3, 2), 11);
  EXPECT_EQ(grid.index(2, 1), 6U);
  EXPECT_EQ(grid.row(2), &grid(0, 2));
  grid(2, 1) = 60;
  EXPECT_EQ(grid[6], 60);
  EXPECT_EQ(grid.data()[6], 60);
}

TEST(Grid, FillsAndCompares) {
  EXPECT_EQ(Grid<float>(2, 2, 3.F)(1, 1), 3.F);
  EXPECT_EQ(Grid<float>(2, 2)(1, 1), 0.F);
  EXPECT_TRUE(Grid<float>().empty());
  EXPECT_NE(Grid<float>(2, 3), Grid<float>(3, 2));  // as many cells, another shape
  EXPECT_EQ(Grid<float>(2, 3), Grid<float>(2, 3));
  EXPECT_TRUE(Grid<float>(2, 3).same_size(Grid<int>(2, 3)));
  EXPECT_FALSE(Grid<float>(2, 3).same_size(Grid<int>(3, 2)));
}

TEST(Grid, LentMemoryIsReadWhereItIsAndNeverFreed) {
  std::vector<float> own = {1.F, 2.F, 3.F, 4.F, 5.F, 6.F};
  {
    Grid<float> grid = Grid<float>::lent(own.data(), 3, 2);
    EXPECT_EQ(grid.data(), own.data());
    EXPECT_EQ(grid(2, 1), 6.F);
    Grid<float> copy = grid;
    EXPECT_NE(copy.data(), own.data());
    EXPECT_EQ(copy, grid);
    copy(0, 0) = 9.F;
    EXPECT_EQ(own[0], 1.F);
    Grid<float> moved = std::move(grid);
    EXPECT_EQ(moved.data(), own.data());
    moved = Grid<float>(2, 2, 7.F);  // gives the loan back
    EXPECT_NE(moved.data(), own.data());
    copy = Grid<float>::lent(own.data(), 2, 3);
    EXPECT_EQ(copy(1, 2), 6.F);
  }
  EXPECT_EQ(own, (std::vector<float>{1.F, 2.F, 3.F, 4.F, 5.F, 6.F}));
  EXPECT_TRUE(Grid<float>::lent(nullptr, 0, 0).empty());
}

TEST(Grid, ContainsItsCellsAndClampsToItsBorder) {
  const Grid<int> grid = counted(4, 3);
  EXPECT_TRUE(grid.contains(0, 0));
  EXPECT_TRUE(grid.contains(3, 2));
  EXPECT_FALSE(grid.contains(4, 2));
  EXPECT_FALSE(grid.contains(3, 3));
  EXPECT_FALSE(grid.contains(-1, 0));
  EXPECT_FALSE(grid.contains(0, -1));
  EXPECT_EQ(grid.clamped(-9, -9), 0);
  EXPECT_EQ(grid.clamped(9, 1), 7);
  EXPECT_EQ(grid.clamped(1, 9), 9);
}

TEST(Grid, IndicesSurviveMoreThanTwoToThe31Cells) {
  // The arithmetic alone; such a grid is not allocated.
  Grid<std::byte> line(65536, 1);
  EXPECT_EQ(line.index(7, 65536), 65536ULL * 65536ULL + 7ULL);
}

// Each value encodes its position; high enough that several threads share the rows.
Grid<int> numbered(int width, int height) {
  Grid<int> grid(width, height);
  for (int i = 0; i < width * height; ++i) grid[static_cast<std::size_t>(i)] = i;
  return grid;
}

TEST(GridPart, APartHasTheValuesOfItsRectangle) {
  const Grid<int> part = part_of(numbered(7, 200), {2, 30, 6, 195});
  ASSERT_EQ(part.width(), 4);
  ASSERT_EQ(part.height(), 165);
  for (const auto [x, y] : test::cells(part))
    ASSERT_EQ(part(x, y), (y + 30) * 7 + x + 2) << x << ", " << y;
}

TEST(GridPart, CopyingAPartBackChangesItsRectangleAlone) {
  const Grid<int> whole = numbered(7, 200);
  const PixelRect rect{2, 30, 6, 195};
  Grid<int> blank(7, 200, -1);
  copy_part(blank, part_of(whole, rect), rect.x0, rect.y0);
  for (const auto [x, y] : test::cells(whole)) {
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
