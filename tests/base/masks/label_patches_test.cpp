#include "base/masks/label_patches.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace belvedere {
namespace {

using testing::ElementsAre;

// 1 1 0
// 0 0 1
// 1 0 1
Grid<int> three_patches() {
  Grid<int> cells(3, 3, 0);
  cells(0, 0) = cells(1, 0) = cells(2, 1) = cells(0, 2) = cells(2, 2) = 1;
  return cells;
}

TEST(LabelPatches, AreConnectedBySidesInTheOrderOfTheirFirstCells) {
  const LabelPatches<int> patches = find_patches(three_patches(), [](int) { return false; });
  EXPECT_THAT(patches.labels, ElementsAre(1, 0, 0, 1, 1));
  EXPECT_THAT(patches.sizes, ElementsAre(2, 1, 3, 2, 1));
  EXPECT_EQ(patches.of_cell(1, 2), patches.of_cell(0, 1));
}

TEST(LabelPatches, AreConnectedByCornersWhereAsked) {
  const LabelPatches<int> patches =
      find_patches(three_patches(), [](int label) { return label == 1; });
  EXPECT_THAT(patches.labels, ElementsAre(1, 0, 0, 1));
  EXPECT_THAT(patches.sizes, ElementsAre(4, 1, 3, 1));
}

}  // namespace
}  // namespace belvedere
