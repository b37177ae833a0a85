#include "texture/composite/make_label_map.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

// Ragged patches of two labels and, in them, of a third.
Grid<std::uint8_t> patches(int side, std::uint64_t seed) {
  Grid<std::uint8_t> map(side, side);
  for (const auto [x, y] : test::cells(side, side)) {
    const double wide =
        gaussian_noise(seed, x, y, 12.0) + .25 * gaussian_noise(seed + 1, x, y, 2.0);
    map(x, y) = wide > 1.1 ? 2 : wide > 0.0 ? 1 : 0;
  }
  return map;
}

Grid<std::uint8_t> stripes(int width, int height) {
  return test::grid_of<std::uint8_t>(width, height, [&](int, int y) { return 3 * y / height; });
}

double share_in_rows(const Grid<std::uint8_t>& map, int y0, int y1, int label) {
  double n = 0.0;
  for (const auto [x, y] : test::cells({0, y0, map.width(), y1}))
    n += map(x, y) == label ? 1.0 : 0.0;
  return n / (map.width() * (y1 - y0));
}

TEST(MakeLabelMap, PatchesComeNearInPairsAndBorders) {
  const LabelMapModel model = learn_label_map(patches(192, 5), 3);
  const LabelMapFigures with = label_map_figures(model, make_label_map(model, 192, 192, {}));
  // The difference of another piece of the same pattern: the natural lower bound.
  const LabelMapFigures floor = label_map_figures(model, patches(192, 77));
  EXPECT_LT(with.pairs, .5 * floor.pairs);
  EXPECT_LT(with.rings, .5 * floor.rings);
  const auto wanted = border_shares(model);
  for (std::size_t s = 0; s < label_scales; ++s)
    EXPECT_NEAR(with.borders[s] / wanted[s], 1.0, .08) << s;
  // Pairs alone do not determine the shape of borders.
  const LabelMapFigures without =
      label_map_figures(model, make_label_map(model, 192, 192, {.rings = false}));
  EXPECT_GT(without.rings, 1.3 * with.rings);
}

TEST(MakeLabelMap, AMapOfTwiceTheSizeHasTheSamePairs) {
  const LabelMapModel model = learn_label_map(patches(160, 8), 3);
  EXPECT_LT(label_map_figures(model, make_label_map(model, 320, 320, {.effort = .6})).pairs, .05);
}

TEST(MakeLabelMap, StripesKeepTopAndBottom) {
  const LabelMapModel model = learn_label_map(stripes(96, 96), 3);
  for (const int height : {96, 180}) {
    const Grid<std::uint8_t> map = make_label_map(model, 100, height, {.effort = .5});
    EXPECT_GT(share_in_rows(map, 0, height / 4, 0), .98);
    EXPECT_GT(share_in_rows(map, 5 * height / 12, 7 * height / 12, 1), .9);
    EXPECT_GT(share_in_rows(map, 3 * height / 4, height, 2), .98);
  }
}

// Clouds in one band of a sky. Pairs alone determine that there is a band, and the edges of the
// map, but not the position of the band.
TEST(MakeLabelMap, LayoutIsKeptOfWhatCouldLieAnywhere) {
  Grid<std::uint8_t> crop = patches(192, 21);
  for (const auto [x, y] : test::cells(192, 192))
    crop(x, y) = y >= 40 && y < 80 && crop(x, y) > 0 ? 1 : 0;
  const LabelMapModel model = learn_label_map(crop, 2);
  const double there = share_in_rows(crop, 45, 75, 1);
  const Grid<std::uint8_t> with = make_label_map(model, 192, 192, {.effort = .5});
  EXPECT_NEAR(share_in_rows(with, 45, 75, 1), there, .2 * there);
  EXPECT_LT(share_in_rows(with, 100, 160, 1), .05);
  const Grid<std::uint8_t> without =
      make_label_map(model, 192, 192, {.seed = 2, .layout = false, .effort = .5});
  EXPECT_GT(share_in_rows(without, 100, 160, 1), .15);
}

TEST(MakeLabelMap, ThreadsChangeNothingAndSeedsDo) {
  const LabelMapModel model = learn_label_map(patches(96, 3), 3);
  const LabelMapParameters quick{.effort = .2};
  const Grid<std::uint8_t> many = make_label_map(model, 101, 75, quick);
  const ThreadLimit one(1);
  EXPECT_EQ(make_label_map(model, 101, 75, quick), many);
  EXPECT_NE(make_label_map(model, 101, 75, {.seed = 2, .effort = .2}), many);
}

TEST(MakeLabelMap, SmallAndLargeSizesAreLimited) {
  const LabelMapModel model = learn_label_map(patches(64, 3), 3);
  EXPECT_EQ(make_label_map(model, 3, 1, {.effort = .2}).width(), 3);
  EXPECT_THROW(make_label_map(model, 0, 5, {}), Error);
  EXPECT_THROW(make_label_map(model, 1 << 18, 1 << 18, {}), Error);
}

// Maps over the limit are sampled on every second, fourth … pixel, at the scale of the model.
TEST(MakeLabelMap, LargeMapsHaveCoarserBordersAndTheSameScale) {
  const LabelMapModel model = learn_label_map(patches(160, 8), 3);
  const Grid<std::uint8_t> map =
      make_label_map(model, 201, 200, {.effort = .6, .finest_pixels = 201 * 200 / 3});
  ASSERT_EQ(map.width(), 201);
  ASSERT_EQ(map.height(), 200);
  for (const auto [x, y] : test::cells(201, 200)) ASSERT_EQ(map(x, y), map(x & ~1, y & ~1));
  const LabelMapFigures figures = label_map_figures(model, map);
  const auto wanted = border_shares(model);
  for (std::size_t s = 1; s < label_scales; ++s)
    EXPECT_NEAR(figures.borders[s] / wanted[s], 1.0, .25) << s;
}

}  // namespace
}  // namespace belvedere
