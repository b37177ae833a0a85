#include "texture/statistical/cracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/masks/label_blur.h"
#include "base/random.h"
#include "tests/grids.h"
#include "tests/texture/statistical/texture_crops.h"

namespace belvedere {
namespace {

constexpr Rgb8 black{14, 10, 6};

// A meadow with winding cracks, two to three pixels wide; their share of it is returned.
double cracked_meadow(Grid<Rgb8>& crop) {
  crop = test::meadow_crop(128, 112);
  double cracked = 0.0;
  for (const auto [x, y] : test::cells(crop))
    if (std::abs(gaussian_noise(21, x, y, 9.0, 9.0)) < .12) {
      crop(x, y) = black;
      cracked += 1.0;
    }
  return cracked / static_cast<double>(crop.size());
}

const LearnParameters few_types{.types = 20, .levels = 2, .rounds = 6};

TEST(Cracks, AreTheDarkestPixelsAndNotPartOfTheIntactTexture) {
  Grid<Rgb8> crop;
  const double share = cracked_meadow(crop);
  const CrackModel cracks = learn_cracks(crop, {}, share, few_types);
  EXPECT_NEAR(cracks.share, share, .005);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(cracks.colour[c], black[c], 2) << c;
  int intact = 0;
  for (const auto [x, y] : test::cells(crop)) {
    if (cracks.intact(x, y) == 0) continue;
    ++intact;
    for (int v = -2; v <= 2; ++v)
      for (int u = -2; u <= 2; ++u) ASSERT_NE(crop.clamped(x + u, y + v), black);
  }
  EXPECT_GT(intact, 2000);
}

// Step by step more of them, each step over the one before, in the end as many as in the crop.
TEST(Cracks, GrowOverAPictureStepByStep) {
  Grid<Rgb8> crop;
  const double share = cracked_meadow(crop);
  const CrackModel cracks = learn_cracks(crop, {}, share, few_types);
  const Grid<Rgb8> white(150, 140, Rgb8{250, 250, 250});
  const std::vector<Grid<Rgb8>> series = lay_cracks(white, cracks, 3, 5);
  ASSERT_EQ(series.size(), 3U);
  std::vector<double> dark;
  for (std::size_t k = 0; k < series.size(); ++k) {
    double count = 0.0;
    for (std::size_t i = 0; i < white.size(); ++i) {
      count += series[k][i][1] < 130 ? 1.0 : 0.0;
      if (k > 0) {
        ASSERT_LE(series[k][i][1], series[k - 1][i][1]) << "what has cracked stays so";
      }
    }
    dark.push_back(count / static_cast<double>(white.size()));
    EXPECT_NEAR(dark[k], share * (static_cast<double>(k) + 1.0) / 3.0, .03) << k;
  }
  EXPECT_GT(dark[0], .01);
  EXPECT_GT(dark[2], dark[1] + .02);
  // Most of it is untouched, to the bit.
  EXPECT_GT(std::count(series[2].begin(), series[2].end(), white[0]),
            static_cast<std::ptrdiff_t>(white.size() / 2));
  EXPECT_EQ(lay_cracks(white, cracks, 3, 5), series);
  EXPECT_NE(lay_cracks(white, cracks, 3, 6), series);
}

// Pixels of the largest connected part of what is dark, and its share of all that is.
struct LargestPart {
  double pixels = 0.0, share = 0.0;
};
LargestPart largest_dark_part(const Grid<Rgb8>& picture) {
  Grid<std::uint8_t> dark(picture.width(), picture.height());
  for (std::size_t i = 0; i < dark.size(); ++i) dark[i] = picture[i][1] < 130 ? 1 : 0;
  const auto patches = find_patches(dark, [](std::uint8_t) { return true; });
  LargestPart out;
  for (std::size_t k = 0; k < patches.sizes.size(); ++k)
    if (patches.labels[k] == 1)
      out.pixels = std::max(out.pixels, static_cast<double>(patches.sizes[k]));
  out.share = out.pixels / static_cast<double>(std::max<std::ptrdiff_t>(
                               1, std::count(dark.begin(), dark.end(), std::uint8_t{1})));
  return out;
}

// The crop's cracks are few and long. As a texture of levels they came out in pieces, the longest a
// fiftieth of all; they are joined until there are as few as in the crop, and no fewer.
TEST(Cracks, AreJoinedAsInTheCrop) {
  Grid<Rgb8> crop;
  const double share = cracked_meadow(crop);
  CrackModel cracks = learn_cracks(crop, {}, share, few_types);
  EXPECT_LT(cracks.pieces, .02) << "lines of more than 50 pixels each";
  const Grid<Rgb8> white(200, 180, Rgb8{250, 250, 250});
  const LargestPart joined = largest_dark_part(lay_cracks(white, cracks, 1, 5).front());
  cracks.pieces = 1.0;  // each pixel by itself: nothing to join
  const LargestPart apart = largest_dark_part(lay_cracks(white, cracks, 1, 5).front());
  EXPECT_GT(joined.share, .15);
  EXPECT_GT(joined.pixels, 2.0 * apart.pixels);
}

}  // namespace
}  // namespace belvedere
