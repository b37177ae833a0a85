#include "terrain/cover/land_cover_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace belvedere {
namespace {

using enum LandCoverClass;

// Cells of 10 m: f forest, r rock, w water, h houses, s snow.
LandCover drawn(const std::vector<std::string>& rows) {
  LandCover cover{
      {Grid<LandCoverClass>(static_cast<int>(rows[0].size()), static_cast<int>(rows.size())),
       {0.0, 0.0, 10.0, 10.0},
       ""}};
  for (int y = 0; y < cover.classes.cells.height(); ++y)
    for (int x = 0; x < cover.classes.cells.width(); ++x) {
      const char c = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
      cover.classes.cells(x, y) = c == 'f'   ? forest
                                  : c == 'r' ? rock
                                  : c == 'w' ? water
                                  : c == 'h' ? settlement
                                             : snow;
    }
  return cover;
}

std::vector<std::string> picture(const LandCover& cover) {
  std::vector<std::string> rows;
  for (int y = 0; y < cover.classes.cells.height(); ++y) {
    rows.emplace_back();
    for (int x = 0; x < cover.classes.cells.width(); ++x) {
      const LandCoverClass id = cover.classes.cells(x, y);
      rows.back() += id == forest       ? 'f'
                     : id == rock       ? 'r'
                     : id == water      ? 'w'
                     : id == settlement ? 'h'
                                        : 's';
    }
  }
  return rows;
}

using Rows = std::vector<std::string>;

TEST(LandCoverPatches, SmallOnesGoToTheNearestLargeOne) {
  const Rows rows = {"fffffrrrrr", "frrffrrrrr", "frrffrrfrr", "fffffrrrrr"};
  // 4 cells of rock in the forest, 1 of forest in the rock; 400 m² is not below 400.
  EXPECT_EQ(picture(remove_small_patches(drawn(rows), {.smallest_m2 = 400.0}).cover),
            (Rows{"fffffrrrrr", "frrffrrrrr", "frrffrrrrr", "fffffrrrrr"}));
  EXPECT_EQ(picture(remove_small_patches(drawn(rows), {.smallest_m2 = 410.0}).cover),
            (Rows{"fffffrrrrr", "fffffrrrrr", "fffffrrrrr", "fffffrrrrr"}));
  EXPECT_EQ(picture(remove_small_patches(drawn(rows), {}).cover), rows);
}

TEST(LandCoverPatches, CornersDoNotJoin) {
  const Rows rows = {"rffff", "frfff", "ffrff", "fffff"};
  EXPECT_EQ(picture(remove_small_patches(drawn(rows), {.smallest_m2 = 300.0}).cover),
            Rows(4, "fffff"));
}

TEST(LandCoverPatches, RiversAndHamletsStayAndHamletsGrow) {
  const Rows rows = {"wffffffff", "fwfffffff", "ffwffffff", "fffwfffhf", "ffffwffff", "fffffwfff"};
  const PatchResult result = remove_small_patches(drawn(rows), {.smallest_m2 = 500.0});
  // Six cells of river, joined by corners, are enough; one house becomes five.
  EXPECT_EQ(picture(result.cover),
            (Rows{"wffffffff", "fwfffffff", "ffwffffhf", "fffwffhhh", "ffffwffhf", "fffffwfff"}));
}

TEST(LandCoverPatches, GrowthHasAnEndAndSparesWhatIsKept) {
  const Rows rows = {"wwwwwwwwwww", "wwwwwwwwwww", "fffffhfffff", "fffffffffff",
                     "fffffffffff", "fffffffffff", "fffffffffff"};
  // 22 cells are needed; three to each side, except in water, make 16.
  EXPECT_EQ(picture(remove_small_patches(drawn(rows), {.smallest_m2 = 2200.0}).cover),
            (Rows{"wwwwwwwwwww", "wwwwwwwwwww", "ffhhhhhhhff", "fffhhhhhfff", "ffffhhhffff",
                  "fffffhfffff", "fffffffffff"}));
}

TEST(LandCoverPatches, WhatGoesIsNotFilledWithWater) {
  const Rows rows = {"wwwwwww", "wrwwwww", "wwwwwww", "fffffff", "fffffff"};
  EXPECT_EQ(picture(remove_small_patches(drawn(rows), {.smallest_m2 = 300.0}).cover)[1], "wfwwwww");
}

TEST(LandCoverPatches, ReportsAreasAndPatches) {
  const PatchResult result = remove_small_patches(
      drawn({"fffffrrrrr", "frrffrrrrr", "frrffrrfrr", "fffffrrrrr"}), {.smallest_m2 = 410.0});
  ASSERT_EQ(result.areas.size(), 2U);
  const ClassArea& woods = result.areas[0];
  EXPECT_EQ(woods.id, forest);
  EXPECT_DOUBLE_EQ(woods.before_m2, 1700.0);
  EXPECT_DOUBLE_EQ(woods.after_m2, 2000.0);
  EXPECT_EQ(woods.patches_before, 2);
  EXPECT_EQ(woods.patches_after, 1);
  EXPECT_DOUBLE_EQ(result.areas[1].before_m2 - result.areas[1].after_m2, 300.0);
}

TEST(LandCoverPatches, WhereEverythingIsSmallNothingGoes) {
  const Rows rows = {"fr", "rf"};
  EXPECT_EQ(picture(remove_small_patches(drawn(rows), {.smallest_m2 = 1e6}).cover), rows);
}

}  // namespace
}  // namespace belvedere
