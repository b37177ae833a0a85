#include "texture/statistical/photometric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "base/colour/hsv.h"
#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "tests/texture/statistical/texture_crops.h"

namespace belvedere {
namespace {

double even(std::uint64_t seed, int x, int y) {
  return static_cast<double>(random_index(10001, seed, x, y)) / 10000.0;
}

// Upper half one hue and light, lower half another and dark; saturation and value vary evenly.
struct Look {
  double hue, saturation, value;
};
Grid<glm::vec3> two_halves(Look upper, Look lower, std::uint64_t seed, int width = 96,
                           int height = 96) {
  Grid<glm::vec3> out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Look& look = y < height / 2 ? upper : lower;
      out(x, y) = from_hsv({look.hue + .04 * (even(seed, x, y) - .5),
                            look.saturation + .2 * (even(seed + 1, x, y) - .5),
                            look.value + .2 * (even(seed + 2, x, y) - .5)});
    }
  return out;
}

// Of a bright and a dark half, the dark one has the crop's hue: it resembles the bright crop more.
TEST(Photometric, WhatResemblesACropIsFoundInAnotherLight) {
  const Grid<glm::vec3> picture = two_halves({.60, .5, .8}, {.30, .6, .35}, 1);
  const Grid<glm::vec3> crop = two_halves({.30, .6, .7}, {.30, .6, .7}, 9);
  const Grid<std::uint8_t> similar = find_similar_colours(picture, crop, .25);
  int found = 0;
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) {
      found += similar(x, y);
      if (y < 40) {
        ASSERT_EQ(similar(x, y), 0);
      }
    }
  EXPECT_NEAR(found, 96 * 96 / 4, 20);
  Grid<std::uint8_t> counts(96, 96, 1);
  for (int y = 48; y < 96; ++y)
    for (int x = 0; x < 48; ++x) counts(x, y) = 0;
  const Grid<std::uint8_t> rest = find_similar_colours(picture, crop, .25, counts);
  for (std::size_t i = 0; i < rest.size(); ++i)
    if (counts[i] == 0) {
      ASSERT_EQ(rest[i], 0);
    }
  EXPECT_THROW(find_similar_colours(picture, crop, .25, Grid<std::uint8_t>(96, 96)), Error);
}

// Of two greens on the same ground it is the hue that decides, not which is as dark as the crop: a
// dim crop resembles bright ground of its hue more than dark ground of another.
TEST(Photometric, ADimCropResemblesBrightGroundOfItsHue) {
  const Grid<glm::vec3> picture = two_halves({.30, .6, .85}, {.18, .6, .3}, 1);
  const Grid<glm::vec3> crop = two_halves({.30, .6, .3}, {.30, .6, .3}, 9);
  const Grid<std::uint8_t> similar = find_similar_colours(picture, crop, .25);
  for (int y = 56; y < 96; ++y)
    for (int x = 0; x < 96; ++x) ASSERT_EQ(similar(x, y), 0) << x << ", " << y;
}

TEST(Photometric, OwnColoursStay) {
  const Grid<glm::vec3> picture = two_halves({.6, .5, .8}, {.3, .6, .4}, 1);
  const Grid<glm::vec3> out = correct_colours(picture, picture, {.regions = 2});
  for (std::size_t i = 0; i < out.size(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(out[i][c], picture[i][c], .01F);
}

// Each half changes hue, saturation and value separately: no single map for both could do it.
TEST(Photometric, RegionsTakeTheirPartnersColours) {
  const Grid<glm::vec3> source = two_halves({.60, .5, .8}, {.30, .6, .4}, 1);
  const Grid<glm::vec3> target = two_halves({.55, .3, .7}, {.20, .7, .3}, 50);
  const Grid<glm::vec3> wanted = two_halves({.55, .3, .7}, {.20, .7, .3}, 1);
  const Grid<glm::vec3> out = correct_colours(source, target, {.regions = 2});
  double off = 0.0;
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x)
      if (std::abs(y - 48) > 12)
        for (int c = 0; c < 3; ++c)
          off = std::max(off, static_cast<double>(std::abs(out(x, y)[c] - wanted(x, y)[c])));
  EXPECT_LT(off, .04);
  const auto before = colour_histogram_distance(source, target);
  const auto after = colour_histogram_distance(out, target);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_LT(after[c], .4 * before[c]) << c;
}

// Grey with a trace of every hue, to be made green: no rainbow results.
TEST(Photometric, GreysTurnWithoutFlecks) {
  Grid<glm::vec3> grey(80, 80);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x)
      grey(x, y) = from_hsv({even(1, x, y), .03 * even(2, x, y), .5 + .1 * even(3, x, y)});
  const Grid<glm::vec3> green = two_halves({.33, .5, .5}, {.33, .5, .6}, 4);
  const Grid<glm::vec3> out = correct_colours(grey, green, {.regions = 1});
  int flecks = 0;
  for (const glm::vec3& rgb : out) {
    const glm::dvec3 hsv = to_hsv(rgb);
    flecks += hsv.y > .15 && std::abs(hsv.x - .33) > .08 ? 1 : 0;
  }
  EXPECT_EQ(flecks, 0);
}

// Green leaves with blue gaps, to be made a narrow yellow: gaps become grey, not bright yellow, and
// leaves keep their colour.
TEST(Photometric, WhatARegionHasLittleOfMakesNoFlecks) {
  Grid<glm::vec3> leaves = two_halves({.33, .5, .5}, {.33, .5, .6}, 4);
  Grid<std::uint8_t> gap(96, 96);
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x)
      if (even(8, x, y) < .03) {
        gap(x, y) = 1;
        leaves(x, y) = from_hsv({.6, .5, .8});
      }
  const Grid<glm::vec3> yellow = two_halves({.16, .8, .5}, {.16, .8, .6}, 5);
  const Grid<glm::vec3> out = correct_colours(leaves, yellow, {.regions = 1});
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (gap[i] != 0)
      EXPECT_LT(to_hsv(out[i]).y, .25);
    else
      EXPECT_GT(to_hsv(out[i]).y, .6);
  }
}

// A small range of brightness is stretched by a factor of 2 at most.
TEST(Photometric, GrainIsNotBlownUp) {
  Grid<glm::vec3> faint(64, 64);
  Grid<glm::vec3> strong(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      faint(x, y) = glm::vec3(static_cast<float>(.5 + .04 * (even(1, x, y) - .5)));
      strong(x, y) = glm::vec3(static_cast<float>(.5 + .8 * (even(2, x, y) - .5)));
    }
  const Grid<glm::vec3> out = correct_colours(faint, strong, {.regions = 1});
  float low = 1.F;
  float high = 0.F;
  for (const glm::vec3& rgb : out) {
    low = std::min(low, rgb.x);
    high = std::max(high, rgb.x);
  }
  EXPECT_NEAR(high - low, .08F, .01F);
}

TEST(Photometric, WhatDoesNotCountIsNotMeasured) {
  const Grid<glm::vec3> source = two_halves({.60, .5, .8}, {.60, .5, .4}, 1);
  Grid<glm::vec3> framed = two_halves({.55, .3, .7}, {.55, .3, .3}, 9);
  Grid<std::uint8_t> counts(96, 96, 1);
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 10; ++x) {
      framed(x, y) = {1.F, 0.F, 0.F};
      counts(x, y) = 0;
    }
  for (const glm::vec3& rgb :
       correct_colours(source, framed, {.regions = 2, .blur_px = 0.0}, {}, counts))
    EXPECT_NEAR(to_hsv(rgb).x, .55, .05);
  EXPECT_THROW(correct_colours(source, framed, {}, {}, Grid<std::uint8_t>(96, 96, 0)), Error);
  EXPECT_THROW(correct_colours(source, framed, {.regions = 6}), Error);
}

TEST(Photometric, SameForAnyThreads) {
  const auto made = [](int threads) {
    const ThreadLimit limit(threads);
    return correct_colours(two_halves({.60, .5, .8}, {.30, .6, .4}, 1),
                           two_halves({.55, .3, .7}, {.20, .7, .3}, 50));
  };
  EXPECT_EQ(made(1), made(2));
}

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
