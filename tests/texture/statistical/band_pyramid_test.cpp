#include "texture/statistical/band_pyramid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/texture/statistical/texture_crops.h"

namespace belvedere {
namespace {

TEST(BandPyramid, PicturesComeBackFromTheirBands) {
  const Grid<Rgb8> crop = test::meadow_crop(64, 48);
  const BandSpace bands = find_bands(crop, {});
  const Grid<Rgb8> back = to_picture(to_bands(crop, bands, {}), bands);
  for (std::size_t i = 0; i < crop.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_LE(std::abs(crop[i][c] - back[i][c]), 1)
          << i;  // half a level of dither in each direction
}

TEST(BandPyramid, ExtentIsThatOfAllPixelsFromTheFirstToTheLast) {
  for (const std::size_t bright : {std::size_t{0}, std::size_t{16 * 16 - 1}}) {
    Grid<Rgb8> crop(16, 16, Rgb8{100, 100, 100});
    crop[bright] = {200, 200, 200};
    const BandSpace bands = find_bands(crop, {});
    EXPECT_NEAR(bands.high[0] - bands.low[0], 100.0 * std::sqrt(3.0) + 1.0, 3.0) << bright;
  }
}

TEST(BandPyramid, AxesAreUnitVectorsAtRightAnglesTheWidestFirst) {
  const Grid<Rgb8> crop = test::meadow_crop(96, 96);
  const BandSpace bands = find_bands(crop, {});
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      float dot = 0.F;
      for (int c = 0; c < 3; ++c) dot += bands.axis(a, c) * bands.axis(b, c);
      EXPECT_NEAR(dot, a == b ? 1.F : 0.F, 1e-3F);
    }
  const BandPicture picture = to_bands(crop, bands, {});
  std::array<double, 3> squares{};
  double cross = 0.0;
  for (std::size_t i = 0; i < crop.size(); ++i) {
    for (std::size_t b = 0; b < 3; ++b) squares[b] += picture.bands[b][i] * picture.bands[b][i];
    cross += picture.bands[0][i] * picture.bands[1][i];
  }
  EXPECT_GT(squares[0], 4.0 * squares[1]);
  EXPECT_GT(squares[1], squares[2]);
  EXPECT_LT(std::abs(cross), .02 * std::sqrt(squares[0] * squares[1]));  // bands are not correlated
}

TEST(BandPyramid, OnlyWhatCountsIsLearnt) {
  Grid<Rgb8> crop = test::meadow_crop(64, 64);
  Grid<std::uint8_t> states(64, 64, pixel_free);
  for (int y = 0; y < 64; ++y)
    for (int x = 40; x < 64; ++x) {
      crop(x, y) = {255, 0, 255};
      states(x, y) = 0;
    }
  const BandSpace bands = find_bands(crop, states);
  EXPECT_LT(bands.mean[2], 80.F);
  const BandPyramid pyramid = make_pyramid(to_bands(crop, bands, states), 2);
  EXPECT_EQ(pyramid[1].states(5, 5), pixel_free);
  EXPECT_EQ(pyramid[1].states(30, 5), 0);
  // A coarse pixel at the border is a mean of meadow pixels only.
  for (int b = 0; b < 3; ++b)
    EXPECT_LT(pyramid[1].band(b)(19, 9), bands.high[static_cast<std::size_t>(b)] + 1.F);
}

TEST(BandPyramid, HalvingAndEnlargingKeepARamp) {
  BandPicture fine(32, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      fine.band(0)(x, y) = 3.F * static_cast<float>(x) - 2.F * static_cast<float>(y);
  BandPicture coarse(16, 16);
  halve(fine, coarse);
  for (int y = 4; y < 28; ++y)
    for (int x = 4; x < 28; ++x)
      EXPECT_NEAR(enlarged(coarse.band(0), x, y), fine.band(0)(x, y), 1e-4F) << x << " " << y;
}

TEST(BandPyramid, ColourThatIsOneHasNoRange) {
  const BandSpace bands = find_bands(Grid<Rgb8>(48, 48, Rgb8{10, 20, 30}), {});
  EXPECT_NEAR(bands.mean[1], 20.F, 1e-4F);
  for (std::size_t b = 0; b < 3; ++b)
    EXPECT_LT(bands.high[b] - bands.low[b], 3.5F);  // the dither and a level
}

}  // namespace
}  // namespace belvedere
