#include "tools/web/tile_pyramid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/parallel.h"
#include "renderer/image/image_io.h"
#include "renderer/image/oiio_file.h"
#include "renderer/image/srgb.h"
#include "tests/files.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

// Smooth, so that JPEG keeps it.
Grid<glm::vec3> slope(int width, int height) {
  Grid<glm::vec3> out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      out(x, y) = {static_cast<float>(x) / static_cast<float>(width),
                   static_cast<float>(y) / static_cast<float>(height), 0.5F};
  return out;
}

TEST(TilePyramid, TilesOfEveryLevelShowThePicture) {
  const test::Folder folder;
  const Grid<glm::vec3> picture = slope(300, 170);
  write_png8(folder / "a.png", picture, {});
  Progress progress;
  const TilePyramid made =
      write_tile_pyramid(folder / "a.png", folder / "tiles", {64, 95}, progress);
  EXPECT_EQ(made.width, 300);
  EXPECT_EQ(made.height, 170);
  ASSERT_EQ(made.levels, 4) << "300, 150, 75, 38 pixels";
  for (int level = 0; level < made.levels; ++level) {
    const int width = (300 + (1 << level) - 1) >> level;
    const int height = (170 + (1 << level) - 1) >> level;
    int tiles = 0;
    for (int row = 0; row * 64 < height; ++row)
      for (int column = 0; column * 64 < width; ++column, ++tiles) {
        const Grid<glm::vec3> tile =
            read_picture(folder / ("tiles/" + std::to_string(level) + "/" + std::to_string(column) +
                                   "_" + std::to_string(row) + ".jpg"));
        ASSERT_EQ(tile.width(), std::min(64, width - 64 * column));
        ASSERT_EQ(tile.height(), std::min(64, height - 64 * row));
        for (int y = 0; y < tile.height() - 1; y += 9)
          for (int x = 0; x < tile.width() - 1; x += 7) {
            const double at = (64.0 * column + x + 0.5) * (1 << level);
            EXPECT_NEAR(tile(x, y).x, at / 300.0, 0.03) << level << ": " << column << ", " << row;
            EXPECT_NEAR(tile(x, y).z, 0.5, 0.03) << "colours are kept at half the size";
          }
      }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / ("tiles/" + std::to_string(level))),
                            fs::directory_iterator()),
              tiles);
  }
}

// Black and white stripes of a pixel become the grey of half the light, not of half the number.
TEST(TilePyramid, SmallerLevelsAreMeansOfLight) {
  const test::Folder folder;
  Grid<glm::vec3> stripes(128, 128);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) stripes(x, y) = glm::vec3(x % 2 == 0 ? 0.F : 1.F);
  write_png8(folder / "a.png", stripes, {});
  Progress progress;
  ASSERT_EQ(write_tile_pyramid(folder / "a.png", folder / "tiles", {64, 95}, progress).levels, 2);
  EXPECT_NEAR(read_picture(folder / "tiles/1/0_0.jpg")(30, 30).x, srgb_encoded(0.5), 0.01);
}

TEST(TilePyramid, ThreadsChangeNoByte) {
  const test::Folder folder;
  write_png8(folder / "a.png", slope(300, 170), {});
  Progress progress;
  write_tile_pyramid(folder / "a.png", folder / "two", {64, 88}, progress);
  const ThreadLimit one(1);
  write_tile_pyramid(folder / "a.png", folder / "one", {64, 88}, progress);
  for (const char* tile : {"/0/0_0.jpg", "/0/4_2.jpg", "/2/1_0.jpg"})
    EXPECT_EQ(test::read_bytes(folder / "two" + tile), test::read_bytes(folder / "one" + tile))
        << tile;
}

}  // namespace
}  // namespace belvedere::tools
