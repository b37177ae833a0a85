#include "texture/statistical/label_borders.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace belvedere {
namespace {

TEST(LabelBorders, MasksAreWidenedByASquare) {
  Grid<std::uint8_t> mask(20, 15);
  mask(6, 7) = 1;
  mask(19, 0) = 5;
  const Grid<std::uint8_t> wide = widened(mask, 3);
  for (int y = 0; y < 15; ++y)
    for (int x = 0; x < 20; ++x) {
      const bool first = std::abs(x - 6) <= 3 && std::abs(y - 7) <= 3;
      const bool second = x >= 16 && y <= 3;
      EXPECT_EQ(wide(x, y), first || second ? 1 : 0) << x << " " << y;
    }
  EXPECT_EQ(widened(mask, 0)(19, 0), 1);
}

TEST(LabelBorders, LieOnBothSidesAndNotAtWhatIsUnknown) {
  Grid<std::uint8_t> labels(30, 10, 1);
  for (int y = 0; y < 10; ++y) {
    for (int x = 15; x < 30; ++x) labels(x, y) = 4;
    for (int x = 25; x < 30; ++x) labels(x, y) = no_label;
  }
  for (const int px : {1, 3, 6}) {
    const Grid<std::uint8_t> near = near_borders(labels, px);
    for (int x = 0; x < 30; ++x)
      EXPECT_EQ(near(x, 5), x >= 15 - px && x < 15 + px ? 1 : 0) << px << " " << x;
  }
}

}  // namespace
}  // namespace belvedere
