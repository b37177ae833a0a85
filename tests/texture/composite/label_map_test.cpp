#include "texture/composite/label_map.h"

#include <gtest/gtest.h>

#include <numeric>

#include "base/error.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

TEST(LabelMap, ACheckerboardHasKnownTables) {
  const LabelMapModel model = learn_label_map(
      test::grid_of<std::uint8_t>(64, 64, [](int x, int y) { return (x + y) % 2; }), 2);
  const auto table = [&](int scale, int offset) {
    return model.pairs.data() + model.pair_table(scale, offset);
  };
  // Direct neighbours: never equal. Across a corner, two apart, and at every coarser scale: always.
  for (const int offset : {0, 1}) {
    EXPECT_EQ(table(0, offset)[0], 0.F);
    EXPECT_NEAR(table(0, offset)[1], .5F, .01F);
  }
  for (const int offset : {2, 3, 4, 5}) EXPECT_NEAR(table(0, offset)[0], .5F, .01F);
  EXPECT_EQ(table(3, 0)[1], 0.F);
  // The corners of the ring are equal, its sides are not.
  EXPECT_EQ(model.rings[1U << 0 | 1U << 2 | 1U << 5 | 1U << 7], 1.F);
  EXPECT_EQ(model.rings[ring_patterns + 255], 1.F);
}

TEST(LabelMap, HeadsAndTailsAreNotMistaken) {
  // Label 1 is right of 0 and below 2.
  const LabelMapModel model = learn_label_map(
      test::grid_of<std::uint8_t>(60, 60, [](int x, int y) { return y < 30   ? 2
                                                                    : x < 30 ? 0
                                                                             : 1; }),
      3);
  const auto share = [&](int offset, std::size_t tail, std::size_t head) {
    return model.pairs[model.pair_table(0, offset) + 3 * tail + head];
  };
  EXPECT_GT(share(0, 0, 1), 0.F);
  EXPECT_EQ(share(0, 1, 0), 0.F);
  EXPECT_GT(share(1, 2, 1), 0.F);
  EXPECT_EQ(share(1, 1, 2), 0.F);
}

TEST(LabelMap, LengthOfBordersIsExact) {
  // One vertical border in a map of 64 × 48: of 63 neighbours per row one differs, of those s apart
  // s do, as long as they cross it.
  const LabelMapModel model = learn_label_map(
      test::grid_of<std::uint8_t>(64, 48, [](int x, int) { return x < 32 ? 0 : 1; }), 2);
  const auto shares = border_shares(model);
  for (int scale = 0; scale < label_scales; ++scale) {
    const double step = 1 << scale;
    EXPECT_NEAR(shares[static_cast<std::size_t>(scale)], .5 * step / (64.0 - step), 1e-6) << scale;
  }
}

TEST(LabelMap, ProfileFollowsTheHeight) {
  const LabelMapModel model = learn_label_map(
      test::grid_of<std::uint8_t>(20, 160, [](int, int y) { return y < 80 ? 0 : 1; }), 2);
  for (std::size_t strip = 0; strip < label_strips; ++strip) {
    EXPECT_NEAR(model.profile[2 * strip] + model.profile[2 * strip + 1], 1.F, 1e-6);
    if (strip < 7) {
      EXPECT_EQ(model.profile[2 * strip], 1.F) << strip;
    }
    if (strip > 8) {
      EXPECT_EQ(model.profile[2 * strip], 0.F) << strip;
    }
  }
  // The two strips next to the border are mixed equally, as far as 256ths of a strip can express
  // it.
  EXPECT_NEAR(model.profile[2 * 7], 1.F - model.profile[2 * 8], 1.0 / 256.0);
  EXPECT_NEAR(model.profile[2 * 7], .875F, .01F);
  EXPECT_EQ(strip_position(0, 160).upper, 0);
  EXPECT_EQ(strip_position(0, 160).lower_256, 0);
  EXPECT_EQ(strip_position(159, 160).upper, label_strips - 2);
  EXPECT_EQ(strip_position(159, 160).lower_256, 256);
}

TEST(LabelMap, LayoutIsCountedOnceAMapAndPatchesByArea) {
  const LabelMapModel sky = learn_label_map(
      test::grid_of<std::uint8_t>(64, 64, [](int, int y) { return y < 32 ? 0 : 1; }), 2);
  const LabelMapModel tall = at_size(sky, 64, 128);
  for (int scale = 0; scale < label_scales; ++scale) {
    const std::size_t at = sky.pair_table(scale, 1);
    EXPECT_NEAR(tall.pairs[at + 1], .5F * sky.pairs[at + 1], 1e-6);
    EXPECT_NEAR(std::accumulate(tall.pairs.begin() + static_cast<std::ptrdiff_t>(at),
                                tall.pairs.begin() + static_cast<std::ptrdiff_t>(at) + 4, 0.F),
                1.F, 1e-5);
  }
  EXPECT_NEAR(1.F - tall.rings[255], .5F * (1.F - sky.rings[255]), 1e-6);
  // For a map that is really twice as high, this is correct.
  const auto off = label_map_figures(
      sky, test::grid_of<std::uint8_t>(64, 128, [](int, int y) { return y < 64 ? 0 : 1; }));
  EXPECT_LT(off.pairs_for_size, .25 * off.pairs);
  EXPECT_LT(off.profile, 1e-6);

  const auto board = [](int w, int h) {
    return test::grid_of<std::uint8_t>(w, h, [](int x, int y) { return (x / 8 + y / 8) % 2; });
  };
  EXPECT_LT(label_map_figures(learn_label_map(board(128, 128), 2), board(256, 256)).pairs_for_size,
            .02);
}

TEST(LabelMap, CountsOfLabelsHaveLimits) {
  const Grid<std::uint8_t> one(64, 64);
  EXPECT_THROW(learn_label_map(one, 1), Error);
  EXPECT_THROW(learn_label_map(one, 17), Error);
  EXPECT_NO_THROW(learn_label_map(one, 16));
}

}  // namespace
}  // namespace belvedere
