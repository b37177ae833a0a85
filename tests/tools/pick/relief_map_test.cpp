#include "tools/pick/relief_map.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "renderer/image/image_io.h"
#include "terrain/io/crs.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere::tools {
namespace {

float brightness(glm::vec3 colour) { return (colour.x + colour.y + colour.z) / 3.F; }

// A ridge from south to north, with low ground west of it at the same altitudes as east of it.
Dem ridge() {
  return make_dem(
      {test::grid_of(60, 40, [](int x, int) { return 2000.0 - 40.0 * std::abs(x - 30); }),
       {0.0, 4000.0, 100.0, 100.0},
       normalize_crs("EPSG:32632")});
}

TEST(ReliefMap, IsLitFromTheWestAndGreenInTheValleys) {
  const ReliefMap map = relief_map(ridge());
  EXPECT_EQ(map.cells_per_px, 1);
  EXPECT_EQ(map.picture.width(), 60);
  EXPECT_GT(brightness(map.picture(20, 20)), brightness(map.picture(40, 20)) + 0.15F);
  const glm::vec3 low = map.picture(2, 20), high = map.picture(28, 20);
  EXPECT_GT(low.y, low.x) << "green";
  EXPECT_LT(std::abs(high.x - high.z), std::abs(low.y - low.z)) << "pale";
}

TEST(ReliefMap, HasNoReliefWithoutDataAndIsReduced) {
  Dem dem = ridge();
  dem.filled = Grid<std::uint8_t>(60, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 10; ++x) dem.filled(x, y) = 1;
  const ReliefMap map = relief_map(dem, 30);
  EXPECT_EQ(map.cells_per_px, 2);
  EXPECT_EQ(map.picture.width(), 30);
  EXPECT_EQ(map.picture.height(), 20);
  EXPECT_EQ(map.picture(0, 0), map.picture(4, 19)) << "grey";
  EXPECT_NE(map.picture(5, 0), map.picture(4, 0));
}

TEST(PictureTiles, AreThoseOfTheFiles) {
  Grid<glm::vec3> picture(150, 90);
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 150; ++x)
      picture(x, y) = {static_cast<float>(x) / 150.F, static_cast<float>(y) / 90.F, 0.5F};
  const test::Folder folder;
  write_png8(folder / "a.png", picture, {});
  Progress progress;
  const TilePyramid written =
      write_tile_pyramid(folder / "a.png", folder / "tiles", {64, 90}, progress);
  // What the file has, to the bit.
  const PictureTiles tiles = picture_tiles(read_picture(folder / "a.png"), {64, 90});
  EXPECT_EQ(tiles.pyramid.width, 150);
  EXPECT_EQ(tiles.pyramid.height, 90);
  EXPECT_EQ(tiles.pyramid.levels, written.levels);
  EXPECT_EQ(tiles.files.size(), 6U + 2U + 1U) << "150 × 90, 75 × 45, 38 × 23";
  for (const auto& [name, bytes] : tiles.files)
    EXPECT_EQ(bytes, test::read_bytes(folder / ("tiles/" + name))) << name;
}

}  // namespace

}  // namespace belvedere::tools
