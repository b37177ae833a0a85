#include "terrain/cover/land_cover_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/grids.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// Cells of 10 m: f forest, r rock, w water, h houses, s snow.
LandCover drawn(const std::vector<std::string>& rows) {
  LandCover cover{
      {Grid<LandCoverClass>(static_cast<int>(rows[0].size()), static_cast<int>(rows.size())),
       {0.0, 0.0, 10.0, 10.0},
       ""}};
  for (const auto [x, y] : test::cells(cover.classes.cells)) {
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

using enum LandCoverClass;

// A round snowfield of a radius on scree, in cells of a size, with a lake that covers its eastern
// part beyond `lake_m`.
LandCover snowfield(double cell_m, double radius_m, double lake_m = 1e9) {
  const int side = static_cast<int>(1600.0 / cell_m);
  LandCover cover{
      {Grid<LandCoverClass>(side, side, scree), {680000.0, 5240000.0, cell_m, cell_m}, ""}};
  for (const auto [x, y] : test::cells(side, side)) {
    const double east = (x + .5) * cell_m - 800.0;
    const double south = (y + .5) * cell_m - 800.0;
    if (east > lake_m)
      cover.classes.cells(x, y) = water;
    else if (east * east + south * south <= radius_m * radius_m)
      cover.classes.cells(x, y) = snow;
  }
  return cover;
}

double radius_m(const LandCover& cover) {
  const Grid<LandCoverClass>& cells = cover.classes.cells;
  const double area = static_cast<double>(std::count(cells.begin(), cells.end(), snow)) *
                      std::pow(cover.classes.transform.cell_x, 2.0);
  return std::sqrt(area / 3.14159265);
}

TEST(LandCoverErosion, AStepIsFiftyMetresInCellsOfAnySize) {
  for (const double cell_m : {10.0, 20.0, 40.0}) {
    double left = 0.0;
    for (const std::uint64_t seed : {1, 2, 3})
      left += radius_m(erode_land_cover(snowfield(cell_m, 600.0), {{snow, 3}}, seed)) / 3.0;
    EXPECT_NEAR(left, 600.0 - 150.0, 30.0) << cell_m;
  }
}

TEST(LandCoverErosion, WhatLiesAroundTakesThePlaceAndShoresStay) {
  const LandCover before = snowfield(20.0, 600.0, 200.0);
  const LandCover after = erode_land_cover(before, {{snow, 2}}, 1);
  bool shore = true;
  for (const auto [x, y] : test::cells(80, 80)) {
    const LandCoverClass was = before.classes.cells(x, y);
    const LandCoverClass is = after.classes.cells(x, y);
    EXPECT_TRUE(was == snow || is == was);
    EXPECT_TRUE(was != snow || is == snow || is == scree);
    if (x == 49 && std::abs(y - 40) < 8)
      shore = shore && is == snow;  // far from scree, beside the lake
  }
  EXPECT_TRUE(shore);
  EXPECT_LT(radius_m(after), radius_m(before));
}

TEST(LandCoverErosion, NothingNamedNothingChanged) {
  const LandCover cover = snowfield(20.0, 300.0);
  EXPECT_EQ(erode_land_cover(cover, {}, 1).classes.cells, cover.classes.cells);
  EXPECT_EQ(erode_land_cover(cover, {{snow, 0}}, 1).classes.cells, cover.classes.cells);
  EXPECT_EQ(erode_land_cover(cover, {{forest, 5}}, 1).classes.cells, cover.classes.cells);
}

// A window of the ground, on the same cells, erodes as the whole does.
TEST(LandCoverErosion, AWindowAgreesWithTheWhole) {
  const LandCover whole = snowfield(20.0, 600.0);
  LandCover window{
      {Grid<LandCoverClass>(50, 50), {680000.0 + 20 * 20.0, 5240000.0 - 2 * 20.0, 20.0, 20.0}, ""}};
  for (const auto [x, y] : test::cells(50, 50))
    window.classes.cells(x, y) = whole.classes.cells(x + 20, y + 2);
  const LandCover all = erode_land_cover(whole, {{snow, 1}}, 4);
  const LandCover part = erode_land_cover(window, {{snow, 1}}, 4);
  for (const auto [x, y] : test::cells({12, 12, 38, 38}))
    EXPECT_EQ(part.classes.cells(x, y), all.classes.cells(x + 20, y + 2)) << x << " " << y;
}

}  // namespace
}  // namespace belvedere
