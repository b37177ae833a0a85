#include "base/pixel_rect.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

TEST(PixelRect, IsHalfOpen) {
  const PixelRect rect{2, 3, 7, 5};
  EXPECT_EQ(rect.width(), 5);
  EXPECT_EQ(rect.height(), 2);
  EXPECT_FALSE(rect.empty());
  EXPECT_TRUE((PixelRect{2, 3, 2, 5}).empty());
}

TEST(PixelRect, IsCutGrownAndMoved) {
  const PixelRect rect{2, 3, 7, 5};
  EXPECT_EQ(intersection(rect, {0, 4, 5, 9}), (PixelRect{2, 4, 5, 5}));
  EXPECT_TRUE(intersection(rect, {7, 0, 9, 9}).empty());  // they share an edge, not a pixel
  EXPECT_EQ(grown(rect, 2), (PixelRect{0, 1, 9, 7}));
  EXPECT_EQ(moved(rect, -2, 10), (PixelRect{0, 13, 5, 15}));
}

}  // namespace
}  // namespace belvedere
