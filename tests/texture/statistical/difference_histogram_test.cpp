#include "texture/statistical/difference_histogram.h"

#include <gtest/gtest.h>

#include "tests/texture/statistical/texture_crops.h"

namespace belvedere {
namespace {

BandSpace bands_to(float reach) {
  BandSpace bands;
  bands.low = {-reach, -reach, -reach};
  bands.high = {reach, reach, reach};
  return bands;
}

// A ramp of 2 per column: every difference three columns apart is 6.
TEST(DifferenceHistogram, RampsHaveOneDifference) {
  BandPicture picture(40, 20);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 40; ++x) picture.band(0)(x, y) = 2.F * static_cast<float>(x) - 40.F;
  const BandSpace bands = bands_to(64.F);
  const CliqueType type{0, 3, 1, 0, 0};
  const DifferenceHistogram histogram = count_differences(picture, bands, type);
  EXPECT_EQ(histogram.total, 37U * 19U);
  EXPECT_EQ(histogram.counts[static_cast<std::size_t>((6.F + 128.F) / 256.F * difference_bins)],
            37U * 19U);
  const CliqueKnots knots = find_knots(histogram, difference_range(bands, type));
  EXPECT_NEAR(knots.front(), 6.F, .25F);
  EXPECT_NEAR(knots.back(), 6.F, .26F);
  // To the left the difference has the opposite sign.
  const DifferenceHistogram left = count_differences(picture, bands, {0, -3, 1, 0, 0});
  EXPECT_EQ(left.counts[static_cast<std::size_t>((-6.F + 128.F) / 256.F * difference_bins)],
            left.total);
}

TEST(DifferenceHistogram, EachCliqueIsCountedOnce) {
  const BandPicture picture(17, 9);
  const BandSpace bands = bands_to(1.F);
  EXPECT_EQ(count_differences(picture, bands, {0, 0, 0, 1, 1}).total, 17U * 9U);
  EXPECT_EQ(count_differences(picture, bands, {0, 4, 0, 0, 1}).total, 13U * 9U);
  EXPECT_EQ(count_differences(picture, bands, {0, -5, 8, 2, 2}).total, 12U * 1U);
  EXPECT_EQ(count_differences(picture, bands, {0, 0, 9, 2, 2}).total, 0U);
}

TEST(DifferenceHistogram, BothEndsCountAndOneMayChange) {
  BandPicture picture(4, 1);
  picture.states(0, 0) = pixel_counts;  // known
  picture.states(1, 0) = pixel_counts;
  picture.states(3, 0) = 0;  // outside
  // Of three pairs, (0, 1) is known on both ends and (2, 3) extends outside.
  EXPECT_EQ(count_differences(picture, bands_to(1.F), {0, 1, 0, 0, 0}).total, 1U);
}

TEST(HistogramGroups, DistanceIsZeroToItselfAndTwoToStrangers) {
  DifferenceHistogram here;
  DifferenceHistogram there;
  for (std::size_t i = 0; i < 100; ++i) {
    here.counts[400 + i] = 10;
    there.counts[i] = 10;
  }
  here.total = there.total = 1000;
  const HistogramGroups groups(here);
  EXPECT_EQ(groups.distance(here).l1, 0.0);
  EXPECT_NEAR(groups.distance(there).l1, 2.0, .03);  // .5 % of the example lie in the outer groups
  DifferenceHistogram half = here;
  for (std::size_t i = 0; i < 50; ++i) half.counts[400 + i] = 0;
  half.total = 500;
  EXPECT_NEAR(groups.distance(half).l1, 1.0, .05);
  EXPECT_LT(groups.distance(half).l2, groups.distance(half).l1);
}

}  // namespace
}  // namespace belvedere
