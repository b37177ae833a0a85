#include "terrain/io/block_means.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/grid.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

Grid<float> wavy_ground(int width, int height) {
  return test::grid_of(width, height, [&](int x, int y) {
    return 900.0 + 37.3 * std::sin(0.7 * x) * std::cos(0.45 * y) + 0.1 * (x * 7 + y);
  });
}

Grid<float> in_strips(const Grid<float>& grid, int rows, int blocks) {
  BlockMeans means(grid.width(), grid.height(), blocks);
  for (int y = 0; y < grid.height(); y += rows)
    means.push(part_of(grid, {0, y, grid.width(), std::min(y + rows, grid.height())}));
  return means.means();
}

TEST(BlockMeans, AreTheMeansOfWholeBlocks) {
  const Grid<float> grid = test::grid_of(9, 6, [&](int x, int y) { return 100 * y + x; });
  EXPECT_EQ(BlockMeans(9, 6, 3).factor(), 3);
  const Grid<float> means = in_strips(grid, 6, 3);
  ASSERT_EQ(means.width(), 3);
  ASSERT_EQ(means.height(), 2);
  for (const auto [x, y] : test::cells(3, 2))
    EXPECT_EQ(means(x, y), static_cast<float>(100 * (3 * y + 1) + 3 * x + 1));
}

TEST(BlockMeans, AreTheSameHoweverTheRowsCome) {
  const Grid<float> grid = wavy_ground(215, 101);
  const Grid<float> whole = in_strips(grid, 101, 40);
  for (const int rows : {1, 5, 6, 7, 50})
    EXPECT_EQ(in_strips(grid, rows, 40), whole) << rows << " rows at once";
}

TEST(BlockMeans, VoidsTakeNoPart) {
  Grid<float> grid(8, 8, 500.F);
  for (const auto [x, y] : test::cells(4, 4)) grid(x, y) = NAN;
  grid(4, 0) = NAN;
  grid(0, 4) = 516.F;
  for (int x = 4; x < 8; ++x)
    for (int y = 4; y < 8; ++y)
      if (y != 5 && x + y != 8) grid(x, y) = NAN;  // 5 of 16 are left
  const Grid<float> means = in_strips(grid, 3, 2);
  EXPECT_TRUE(std::isnan(means(0, 0)));
  EXPECT_EQ(means(1, 0), 500.F);
  EXPECT_EQ(means(0, 1), 501.F);
  EXPECT_TRUE(std::isnan(means(1, 1))) << "less than half of it";
}

TEST(BlockMeansOfAGrid, AreMeansOfWhatABlockHolds) {
  const Grid<float> grid = test::grid_of(5, 3, [&](int x, int y) { return 10 * y + x; });
  const Grid<float> means = block_means(grid, 2);
  ASSERT_EQ(means.width(), 3);
  ASSERT_EQ(means.height(), 2);
  EXPECT_EQ(means(0, 0), 5.5F);   // 0, 1, 10, 11
  EXPECT_EQ(means(2, 0), 9.0F);   // 4, 14: half a block
  EXPECT_EQ(means(1, 1), 22.5F);  // 22, 23
  EXPECT_EQ(means(2, 1), 24.0F);
  EXPECT_EQ(block_means(grid, 1), grid);
}

TEST(RasterThinned, TakesCellsHereAndThereAsTheyStand) {
  const test::Folder folder;
  Raster<float> plane{
      Grid<float>(1000, 600), {600000.0, 5200000.0, 10.0, 10.0}, normalize_crs("EPSG:32632")};
  const auto altitude = [](glm::dvec2 at) {
    return 0.1 * (at.x - 600000.0) + 0.05 * (5200000.0 - at.y);
  };
  for (const auto [x, y] : test::cells(1000, 600))
    plane.cells(x, y) = x < 200 ? NAN : static_cast<float>(altitude(plane.transform.to_crs(x, y)));
  write_raster(folder / "plane.tif", plane);
  RasterSource source;
  source.path = folder / "plane.tif";
  const auto thin = read_thinned(source, 100);
  ASSERT_TRUE(thin);
  EXPECT_EQ(thin->cells.width(), 100);
  EXPECT_EQ(thin->cells.height(), 60);
  EXPECT_EQ(thin->transform, (GeoTransform{600000.0, 5200000.0, 100.0, 100.0}));
  for (const auto [x, y] : test::cells(100, 60)) {
    if (x < 20) {
      EXPECT_TRUE(std::isnan(thin->cells(x, y)));
    } else {
      // Some cell of the ten by ten below: at most 45 m away in each direction.
      EXPECT_NEAR(thin->cells(x, y), altitude(thin->transform.to_crs(x, y)),
                  0.1 * 50.0 + 0.05 * 50.0 + 1e-3);
    }
  }
  source.lowest_m = 400.0;
  EXPECT_TRUE(std::isnan(read_thinned(source, 100)->cells(30, 0)));
}

TEST(RasterThinned, SmallFilesAreThemselves) {
  const test::Folder folder;
  Raster<float> small{
      Grid<float>(40, 30, 7.F), {600000.0, 5200000.0, 10.0, 10.0}, normalize_crs("EPSG:32632")};
  small.cells(3, 4) = 11.F;
  write_raster(folder / "small.tif", small);
  RasterSource source;
  source.path = folder / "small.tif";
  EXPECT_EQ(read_thinned(source, 100)->cells, small.cells);
}

}  // namespace
}  // namespace belvedere
