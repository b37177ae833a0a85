#include "tools/pick/picture_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/image/image_io.h"
#include "tests/files.h"

namespace belvedere::tools {
namespace {

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
