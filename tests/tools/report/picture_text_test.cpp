#include "tools/report/picture_text.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace belvedere::tools {
namespace {

constexpr glm::vec3 paper(1.F);

// Columns and rows of a picture that ink touches.
struct Ink {
  int left = 1000, right = -1, top = 1000, bottom = -1;
};
Ink ink_of(const std::string& text, int scale, int x = 0, int y = 0) {
  Grid<glm::vec3> picture(300, 40, paper);
  draw_text(picture, x, y, text, glm::vec3(0.F), scale);
  Ink ink;
  for (int v = 0; v < picture.height(); ++v)
    for (int u = 0; u < picture.width(); ++u)
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

}  // namespace
}  // namespace belvedere::tools
