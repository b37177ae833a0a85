#include "terrain/layers/fit/fit_cells.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace belvedere {
namespace {

TEST(DrawLabelled, TakesExactlyAsManyAndOnlyLabelled) {
  std::vector<std::uint8_t> labels(10'000, 1);
  for (std::size_t i = 0; i < labels.size(); i += 3) labels[i] = no_class;
  const std::vector<std::uint32_t> drawn = draw_labelled(labels, 1'000);
  EXPECT_EQ(drawn.size(), 1'000U);
  EXPECT_TRUE(std::is_sorted(drawn.begin(), drawn.end()));
  for (const std::uint32_t i : drawn) EXPECT_NE(labels[i], no_class);
  // Uniformly: each tenth of the cells gives its tenth, within four standard deviations.
  for (std::uint32_t t = 0; t != 10; ++t)
    EXPECT_NEAR(
        std::count_if(drawn.begin(), drawn.end(), [t](std::uint32_t i) { return i / 1'000 == t; }),
        100, 38);
  EXPECT_NE(drawn, draw_labelled(labels, 1'000, 1));
  EXPECT_EQ(draw_labelled(labels, 100'000).size(), 6'666U);
}

TEST(MatchingOffsets, GiveEachClassItsArea) {
  // Class 1 is nowhere the most likely, and covers a tenth.
  ClassShares shares{2, {}};
  for (int i = 0; i != 1'000; ++i) {
    const float p = 0.2F * static_cast<float>(i) / 1'000.0F;
    shares.values.insert(shares.values.end(), {1.0F - p, p});
  }
  EXPECT_EQ(count_labels(most_likely(shares), 2)[1], 0U);
  const std::vector<double> wanted = {0.9, 0.1};
  const std::vector<std::uint8_t> likely = most_likely(shares, matching_offsets(shares, wanted));
  EXPECT_NEAR(count_labels(likely, 2)[1], 100, 3);
  EXPECT_EQ(likely[999], 1);  // where its share is largest
  EXPECT_EQ(likely[0], 0);
}

}  // namespace
}  // namespace belvedere
