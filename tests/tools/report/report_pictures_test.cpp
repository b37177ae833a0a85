#include "tools/report/report_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>
#include <tuple>
#include <vector>

#include "renderer/image/image_io.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere::tools {
namespace {

Grid<float> ramp(int width, int height) {
  Grid<float> out(width, height);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<float>(i);
  return out;
}

TEST(ReportPictures, CutTakesAWindow) {
  const Grid<float> part = cut(ramp(5, 4), {1, 2, 4, 4});
  EXPECT_EQ(part.width(), 3);
  EXPECT_EQ(part(0, 0), 11.F);
  EXPECT_EQ(part(2, 1), 18.F);
}

TEST(ReportPictures, ReducesByMeansOfWholeCells) {
  EXPECT_EQ(reduce_to(ramp(5, 4), 5).factor, 1);
  EXPECT_EQ(reduce_to(ramp(5, 4), 5).cells, ramp(5, 4));
  const Reduced half = reduce_to(ramp(5, 4), 4);
  EXPECT_EQ(half.factor, 2);
  EXPECT_EQ(half.cells.width(), 3);
  EXPECT_EQ(half.cells(0, 0), 3.F);   // 0 1 5 6
  EXPECT_EQ(half.cells(2, 0), 6.5F);  // 4 9: fewer at the rim
  const Grid<glm::vec3> picture =
      reduced_picture(Grid<glm::vec3>(6, 6, glm::vec3(0.1F, 0.2F, 0.3F)), 2);
  EXPECT_EQ(picture.width(), 2);
  EXPECT_EQ(picture(1, 1), glm::vec3(0.1F, 0.2F, 0.3F));
}

TEST(ReportPictures, SignedAndHeatRunFromEndToEnd) {
  Grid<float> values(5, 1);
  for (int i = 0; i < 5; ++i) values(i, 0) = static_cast<float>(2 * i - 4);
  const Grid<glm::vec3> grey = signed_picture(values, 2.F);
  EXPECT_EQ(grey(0, 0), glm::vec3(0.F));
  EXPECT_EQ(grey(2, 0), glm::vec3(0.5F));
  EXPECT_EQ(grey(4, 0), glm::vec3(1.F));
  const Grid<glm::vec3> heat = heat_picture(ramp(4, 1), 3.F);
  EXPECT_EQ(heat(0, 0), glm::vec3(0.F));
  EXPECT_EQ(heat(1, 0), glm::vec3(1.F, 0.F, 0.F));
  EXPECT_EQ(heat(2, 0), glm::vec3(1.F, 1.F, 0.F));
  EXPECT_EQ(heat(3, 0), glm::vec3(1.F));
}

TEST(ReportPictures, LoweredGroundIsRedAndRaisedBlue) {
  const Grid<float> before(8, 8, 100.F);
  Grid<float> after = before;
  after(2, 2) = 90.F;
  after(6, 6) = 110.F;
  const Grid<glm::vec3> picture = change_picture(before, after, {30.0, 30.0}, 10.F, 8);
  EXPECT_GT(picture(2, 2).x, picture(2, 2).z + 0.2F);
  EXPECT_GT(picture(6, 6).z, picture(6, 6).x + 0.2F);
  EXPECT_EQ(picture(0, 7).x, picture(0, 7).z);
}

TEST(ReportPictures, EveryLabelHasAColourOfItsOwn) {
  Grid<std::uint8_t> labels(256, 1);
  for (int i = 0; i < 256; ++i) labels(i, 0) = static_cast<std::uint8_t>(i);
  const Grid<glm::vec3> picture = label_picture(labels);
  std::set<std::tuple<float, float, float>> colours;
  for (const glm::vec3& c : picture) colours.emplace(c.x, c.y, c.z);
  EXPECT_EQ(colours.size(), 256U);
  EXPECT_LT(picture(255, 0).x, 0.2F) << "what is excluded is near black";
  EXPECT_EQ(enlarged(picture, 2)(7, 1), picture(3, 0));
}

TEST(ReportPictures, PercentilesAreValuesOfTheGrid) {
  EXPECT_EQ(percentile(ramp(101, 1), 0.0), 0.F);
  EXPECT_EQ(percentile(ramp(101, 1), 0.95), 95.F);
  EXPECT_EQ(percentile(ramp(101, 1), 1.0), 100.F);
  EXPECT_EQ(percentile(Grid<float>(), 0.5), 0.F);
}

TEST(ReportPictures, BestWindowHasMost) {
  Grid<float> score(40, 20, 0.F);
  score(33, 15) = 5.F;
  score(3, 3) = 4.F;
  EXPECT_EQ(best_window(score, {}, 10),
            (PixelRect{25, 10, 35, 20}));  // the first of the two that hold it
  // Only where it may lie.
  Grid<float> where(40, 20, 0.F);
  for (int y = 0; y < 20; ++y) std::fill_n(where.row(y), 10, 1.F);
  EXPECT_EQ(best_window(score, where, 10), (PixelRect{0, 0, 10, 10}));
  EXPECT_EQ(best_window(score, {}, 100), (PixelRect{0, 0, 40, 20}));
}

constexpr glm::vec3 paper(1.F);

// Columns and rows of a picture that ink touches.
struct Ink {
  int left = 1000, right = -1, top = 1000, bottom = -1;
};
Ink ink_of(const std::string& text, int scale, int x = 0, int y = 0) {
  Grid<glm::vec3> picture(300, 40, paper);
  draw_text(picture, x, y, text, glm::vec3(0.F), scale);
  Ink ink;
  for (const auto [u, v] : test::cells(picture))
    if (picture(u, v).x < 0.5F)
      ink = {std::min(ink.left, u), std::max(ink.right, u), std::min(ink.top, v),
             std::max(ink.bottom, v)};
  return ink;
}

TEST(PictureText, StandsInTheRoomItIsSaidToTake) {
  EXPECT_EQ(text_width("", 3), 0);
  EXPECT_GT(text_width("AB", 1), text_width("A", 1));
  EXPECT_NEAR(text_width("altitude 0.3", 2), 2 * text_width("altitude 0.3", 1), 2);
  for (const int scale : {1, 2, 3}) {
    const Ink ink = ink_of("Höhe 12", scale, 5, 3);
    EXPECT_GE(ink.left, 5);
    EXPECT_LT(ink.right, 5 + text_width("Höhe 12", scale));
    EXPECT_GT(ink.right, 5 + text_width("Höhe 1", scale) - 2 * scale);
    EXPECT_LE(ink.bottom, 3 + text_height * scale);
    EXPECT_GT(ink.bottom, 3 + 5 * scale);
  }
}

TEST(PictureText, WhatLiesOutsideIsCutOff) {
  EXPECT_GE(ink_of("LLLLLLLLLLLL", 2, 280, -6).right, 298);
  EXPECT_EQ(ink_of("L", 1, 400, 100).right, -1);
  EXPECT_EQ(ink_of("", 1).right, -1);
}

Grid<glm::vec3> colours(int width, int height) {
  return test::grid_of<glm::vec3>(
      width, height, [&](int x, int y) { return glm::vec3(x, y, (x + y) % 200) / 255.F; });
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
