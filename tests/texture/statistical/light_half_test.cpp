#include "texture/statistical/light_half.h"

#include <gtest/gtest.h>

#include <cstddef>

#include "tests/texture/statistical/texture_crops.h"

namespace belvedere {
namespace {

// Stripes far wider than the blur: each half is one kind of them, except for a blur of their
// borders.
TEST(LightHalf, WideStripesAreOneHalfEach) {
  constexpr int period = 80;
  const Grid<Rgb8> crop = test::striped_crop(160, 64, period);
  const Grid<std::uint8_t> lit = light_half(crop, {}, LightHalf::lit);
  const Grid<std::uint8_t> shaded = light_half(crop, {}, LightHalf::shaded);
  for (int y = 0; y < crop.height(); ++y)
    for (int x = 0; x < crop.width(); ++x) {
      ASSERT_NE(lit(x, y) == pixel_free, shaded(x, y) == pixel_free) << x << " " << y;
      const int in_stripe = x % (period / 2);
      if (in_stripe < 4 || in_stripe >= period / 2 - 4) continue;
      ASSERT_EQ(lit(x, y) == pixel_free, (x / (period / 2)) % 2 == 0) << x << " " << y;
    }
}

// Strokes are not light: stripes of four pixels are in both halves.
TEST(LightHalf, StrokesAreInBothHalves) {
  Grid<Rgb8> crop = test::striped_crop(128, 64, 4);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 128; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        crop(x, y)[c] = static_cast<std::uint8_t>(crop(x, y)[c] + 40);
  const Grid<std::uint8_t> lit = light_half(crop, {}, LightHalf::lit);
  for (int y = 0; y < 24; ++y)
    for (int x = 16; x < 112; ++x) ASSERT_EQ(lit(x, y), pixel_free) << x << " " << y;
  for (int y = 40; y < 64; ++y)
    for (int x = 16; x < 112; ++x) ASSERT_EQ(lit(x, y), 0) << x << " " << y;
}

// Masked pixels count in neither half, nor for the threshold.
TEST(LightHalf, LeavesOutWhatDoesNotCount) {
  Grid<Rgb8> crop = test::striped_crop(160, 64, 80);
  Grid<std::uint8_t> states(160, 64, pixel_free);
  for (int y = 0; y < 64; ++y)
    for (int x = 80; x < 160; ++x) {
      states(x, y) = 0;
      crop(x, y) = {255, 255, 255};
    }
  const Grid<std::uint8_t> lit = light_half(crop, states, LightHalf::lit);
  const Grid<std::uint8_t> shaded = light_half(crop, states, LightHalf::shaded);
  for (int y = 0; y < 64; ++y) {
    EXPECT_EQ(lit(10, y), pixel_free);
    EXPECT_EQ(shaded(70, y), pixel_free);
    EXPECT_EQ(lit(120, y) | shaded(120, y), 0);
  }
}

}  // namespace
}  // namespace belvedere
