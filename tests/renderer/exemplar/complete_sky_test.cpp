#include "renderer/exemplar/complete_sky.h"

#include <gtest/gtest.h>

#include "base/land_cover_class.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr std::uint8_t class_id(LandCoverClass of) { return static_cast<std::uint8_t>(of); }

// The upper 60 of 100 rows of `above`, with a disc of `star` in it; forest below.
Grid<std::uint8_t> night(LandCoverClass above, LandCoverClass star, int star_y = 25) {
  Grid<std::uint8_t> mask(120, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 120; ++x) {
      const bool disc = (x - 60) * (x - 60) + (y - star_y) * (y - star_y) < 100;
      mask(x, y) = class_id(disc ? star : y < 60 ? above : forest);
    }
  return mask;
}

TEST(CompleteSky, ADarkSkyAboveIsSkyWithItsStars) {
  EXPECT_EQ(complete_sky(night(rock, pasture)), night(sky, sky));
}

TEST(CompleteSky, WhatSkySurroundsIsSky) {
  EXPECT_EQ(complete_sky(night(sky, snow)), night(sky, sky));
  // At the picture's edge as well: the edge is not part of the outline.
  EXPECT_EQ(complete_sky(night(sky, snow, 0)), night(sky, sky, 0));
}

TEST(CompleteSky, SummitsAndGroundStay) {
  Grid<std::uint8_t> mask = night(sky, sky);
  for (int y = 30; y < 60; ++y)  // a triangular summit on the forest
    for (int x = 60 - (y - 30); x <= 60 + (y - 30); ++x) mask(x, y) = class_id(rock);
  EXPECT_EQ(complete_sky(mask), mask);
  // A wall of rock without any sky reaches far down: it is not sky.
  const Grid<std::uint8_t> wall(50, 50, class_id(rock));
  EXPECT_EQ(complete_sky(wall)(0, 0), wall(0, 0));
}

}  // namespace
}  // namespace belvedere
