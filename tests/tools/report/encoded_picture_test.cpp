#include "tools/report/encoded_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

#include "renderer/image/image_io.h"
#include "tests/files.h"

namespace belvedere::tools {
namespace {

Grid<glm::vec3> colours(int width, int height) {
  Grid<glm::vec3> picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture(x, y) = glm::vec3(x, y, (x + y) % 200) / 255.F;
  return picture;
}

TEST(EncodedPicture, PngKeepsEveryValue) {
  const test::Folder folder;
  const Grid<glm::vec3> picture = colours(60, 40);
  const std::string bytes = png_bytes(picture);
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
  const Grid<glm::vec3> read = read_picture(folder.write("a.png", bytes));
  ASSERT_TRUE(read.same_size(picture));
  for (std::size_t i = 0; i < read.size(); ++i)
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(read[i][c], picture[i][c], 1e-6F);
}

TEST(EncodedPicture, JpegIsCloseAndSmaller) {
  const test::Folder folder;
  const Grid<glm::vec3> picture = colours(60, 40);
  const std::string bytes = jpeg_bytes(picture);
  EXPECT_EQ(bytes.substr(0, 2), "\xff\xd8");
  EXPECT_LT(jpeg_bytes(picture, 50).size(), bytes.size());
  const Grid<glm::vec3> read = read_picture(folder.write("a.jpg", bytes));
  ASSERT_TRUE(read.same_size(picture));
  double sum = 0.0;
  for (std::size_t i = 0; i < read.size(); ++i) sum += std::abs(read[i].y - picture[i].y);
  EXPECT_LT(sum / static_cast<double>(read.size()), 0.02);
}

TEST(EncodedPicture, SeveralAtOnceDoNotMeet) {
  std::vector<std::string> made(8);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < made.size(); ++i)
    threads.emplace_back([&, i] { made[i] = png_bytes(colours(20 + static_cast<int>(i), 16)); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < made.size(); ++i)
    EXPECT_EQ(made[i], png_bytes(colours(20 + static_cast<int>(i), 16)));
}

}  // namespace
}  // namespace belvedere::tools
