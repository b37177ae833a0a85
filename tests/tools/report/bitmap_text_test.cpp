#include "tools/report/bitmap_text.h"

#include <gtest/gtest.h>

namespace belvedere::tools {
namespace {

constexpr glm::vec3 black(0.F);

Grid<glm::vec3> drawn(const std::string& text, int scale = 1, int x = 0, int y = 0) {
  Grid<glm::vec3> picture(40, 20, glm::vec3(1.F));
  draw_text(picture, x, y, text, black, scale);
  return picture;
}
std::string rows_of(const Grid<glm::vec3>& picture, int width, int height) {
  std::string out;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) out += picture(x, y) == black ? '#' : '.';
    out += '\n';
  }
  return out;
}

TEST(BitmapText, LettersAreFiveByEightDots) {
  EXPECT_EQ(text_width("", 3), 0);
  EXPECT_EQ(text_width("A", 1), 5);
  EXPECT_EQ(text_width("AB", 1), 11);
  EXPECT_EQ(text_width("AB", 2), 22);
  EXPECT_EQ(text_width("é", 1), 5) << "a character of two bytes is one letter";
}

TEST(BitmapText, DrawsWhatIsWritten) {
  EXPECT_EQ(rows_of(drawn("L1"), 11, 8),
            "#.......#..\n"
            "#......##..\n"
            "#.......#..\n"
            "#.......#..\n"
            "#.......#..\n"
            "#.......#..\n"
            "#####..###.\n"
            "...........\n");
  // Twice as large: every dot four.
  const Grid<glm::vec3> one = drawn("L1");
  const Grid<glm::vec3> two = drawn("L1", 2);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 22; ++x) ASSERT_EQ(two(x, y), one(x / 2, y / 2)) << x << " " << y;
}

TEST(BitmapText, WhatItHasNoLetterForIsABox) {
  EXPECT_EQ(drawn("é"), drawn("~"));
  EXPECT_EQ(rows_of(drawn("é"), 5, 3), "#####\n#...#\n#...#\n");
}

TEST(BitmapText, WhatLiesOutsideIsCutOff) {
  const Grid<glm::vec3> picture = drawn("LLLLLLLLLLLL", 2, 30, -6);
  EXPECT_EQ(picture(30, 0), black);
  EXPECT_EQ(drawn("L", 1, 100, 100), Grid<glm::vec3>(40, 20, glm::vec3(1.F)));
}

}  // namespace
}  // namespace belvedere::tools
