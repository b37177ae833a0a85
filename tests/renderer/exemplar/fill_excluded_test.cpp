#include "renderer/exemplar/fill_excluded.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "tests/texture/statistical/texture_crops.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

constexpr int painting_width = 160;
constexpr int painting_height = 120;
constexpr std::uint8_t pasture_label = 10;
constexpr std::uint8_t rock_label = 7;

bool is_lettering(int x, int y) {
  return (x >= 40 && x < 120 && y >= 40 && y < 46) || (x >= 76 && x < 84 && y >= 30 && y < 90);
}

// Meadow left, the same in greys right, with letters over both and the border.
struct LetteredPainting {
  Grid<glm::vec3> picture{painting_width, painting_height};
  Grid<std::uint8_t> labels{painting_width, painting_height};
  Grid<std::uint8_t> excluded{painting_width, painting_height};
  LetteredPainting() {
    const Grid<Rgb8> meadow = test::meadow_crop(painting_width, painting_height);
    for (int y = 0; y < painting_height; ++y)
      for (int x = 0; x < painting_width; ++x) {
        const glm::vec3 green =
            glm::vec3(meadow(x, y)[0], meadow(x, y)[1], meadow(x, y)[2]) / 255.F +
            1e-4F;  // no level of 8 bits
        picture(x, y) = x < 80 ? green : glm::vec3(green.y + .2F);
        labels(x, y) = x < 80 ? pasture_label : rock_label;
        if (!is_lettering(x, y)) continue;
        picture(x, y) = {1.F, 0.F, 0.2F};
        excluded(x, y) = 1;
      }
  }
};

double redness(const glm::vec3& c) { return static_cast<double>(c.x - c.y); }

TEST(FillExcluded, LettersGiveWayToThePaintAroundThem) {
  const LetteredPainting painting;
  const FilledPaint filled = fill_excluded(painting.picture, painting.labels, painting.excluded);
  EXPECT_EQ(filled.left, 0U);
  EXPECT_EQ(filled.filled, static_cast<std::size_t>(
                               std::count(painting.excluded.begin(), painting.excluded.end(), 1)));
  EXPECT_EQ(filled.labels, painting.labels);
  for (int y = 0; y < painting_height; ++y)
    for (int x = 0; x < painting_width; ++x) {
      if (!is_lettering(x, y)) {
        ASSERT_EQ(filled.picture(x, y), painting.picture(x, y))
            << "what is not excluded changed at " << x << ", " << y;
        continue;
      }
      ASSERT_LT(redness(filled.picture(x, y)), .3) << "letters show at " << x << ", " << y;
    }
  // Each class in its own colours: greens are not greys.
  double green = 0.0;
  double grey = 0.0;
  for (int y = 40; y < 46; ++y)
    for (int x = 0; x < 36; ++x) {
      green += static_cast<double>(filled.picture(40 + x, y).y - filled.picture(40 + x, y).z) /
               (36.0 * 6.0);
      grey +=
          static_cast<double>(std::abs(filled.picture(84 + x, y).y - filled.picture(84 + x, y).z)) /
          (36.0 * 6.0);
    }
  EXPECT_GT(green, .2);
  EXPECT_LT(grey, .03);
}

TEST(FillExcluded, PixelsWithoutAClassTakeTheNearest) {
  LetteredPainting painting;
  for (std::size_t i = 0; i < painting.labels.size(); ++i)
    if (painting.excluded[i] != 0) painting.labels[i] = unused_label;
  const FilledPaint filled = fill_excluded(painting.picture, painting.labels, painting.excluded);
  EXPECT_EQ(filled.left, 0U);
  EXPECT_EQ(filled.labels(50, 42), pasture_label);
  EXPECT_EQ(filled.labels(110, 42), rock_label);
}

TEST(FillExcluded, WhatCannotBeLearntStaysUnused) {
  LetteredPainting painting;
  // A class with excluded pixels only.
  for (int x = 40; x < 60; ++x)
    for (int y = 40; y < 46; ++y) painting.labels(x, y) = 3;
  const FilledPaint filled = fill_excluded(painting.picture, painting.labels, painting.excluded);
  EXPECT_EQ(filled.left, 120U);
  EXPECT_EQ(filled.labels(45, 42), unused_label);
  EXPECT_EQ(filled.picture(45, 42), painting.picture(45, 42));
}

TEST(FillExcluded, NothingExcludedNothingChanged) {
  const LetteredPainting painting;
  const FilledPaint filled = fill_excluded(painting.picture, painting.labels,
                                           Grid<std::uint8_t>(painting_width, painting_height));
  EXPECT_EQ(filled.picture, painting.picture);
  EXPECT_EQ(filled.filled, 0U);
}

// Mean and deviation of green minus blue, and of green, over columns of the bar of the letters.
struct BarColours {
  double tint = 0.0, light = 0.0, spread = 0.0;
};
BarColours bar_colours(const Grid<glm::vec3>& picture, int x0, int x1) {
  BarColours out;
  double squares = 0.0;
  const double count = 6.0 * (x1 - x0);
  for (int y = 40; y < 46; ++y)
    for (int x = x0; x < x1; ++x) {
      const glm::dvec3 c(picture(x, y));
      out.tint += (c.y - c.z) / count;
      out.light += c.y / count;
      squares += c.y * c.y / count;
    }
  out.spread = std::sqrt(std::max(0.0, squares - out.light * out.light));
  return out;
}

// Without classes: the two kinds of ground are found, their border goes on under the letters, and
// each side has its own ground's colours.
TEST(RemoveMarked, TheBorderOfTwoGroundsContinuesUnderTheMark) {
  const LetteredPainting painting;
  const Grid<std::uint8_t> all(painting_width, painting_height, 1);
  const FilledPaint removed = remove_marked(painting.picture, all, painting.excluded);
  EXPECT_EQ(removed.left, 0U);
  EXPECT_EQ(removed.filled, static_cast<std::size_t>(
                                std::count(painting.excluded.begin(), painting.excluded.end(), 1)));
  for (int y = 0; y < painting_height; ++y)
    for (int x = 0; x < painting_width; ++x)
      if (!is_lettering(x, y)) {
        ASSERT_EQ(removed.picture(x, y), painting.picture(x, y)) << x << ", " << y;
      }
  // Green is 130 of 255 on the left and .2 more on the right, blue 60 on the left.
  const BarColours left = bar_colours(removed.picture, 40, 77);
  const BarColours right = bar_colours(removed.picture, 83, 120);
  EXPECT_NEAR(left.tint, 70.0 / 255.0, .05);
  EXPECT_NEAR(right.tint, 0.0, .02);
  EXPECT_NEAR(left.light, 130.0 / 255.0, .05);
  EXPECT_NEAR(right.light, 130.0 / 255.0 + .2, .05);
  // Deviations of green: 14 and 11 of 255 and flecks, together .07 to .08.
  EXPECT_NEAR(left.spread, .07, .035);
  EXPECT_NEAR(right.spread, .07, .035);
  // Close to the border, too.
  EXPECT_GT(bar_colours(removed.picture, 72, 77).tint, .15);
  EXPECT_LT(bar_colours(removed.picture, 83, 88).tint, .08);
}

// Ground in light that grows along the row has that light under the mark, which is 40 wide.
TEST(RemoveMarked, TheToneGoesOnUnderTheMark) {
  const Grid<Rgb8> meadow = test::meadow_crop(painting_width, painting_height);
  const auto light = [](int x) { return .15F + 1.3F * static_cast<float>(x) / painting_width; };
  Grid<glm::vec3> picture(painting_width, painting_height);
  Grid<std::uint8_t> marked(painting_width, painting_height);
  for (int y = 0; y < painting_height; ++y)
    for (int x = 0; x < painting_width; ++x) {
      const Rgb8& c = meadow(x, y);
      marked(x, y) = x >= 60 && x < 100 && y >= 40 && y < 80 ? 1 : 0;
      picture(x, y) = marked(x, y) != 0 ? glm::vec3(1.F, 0.F, .2F)
                                        : glm::vec3(c[0], c[1], c[2]) * (light(x) / 255.F);
    }
  const Grid<std::uint8_t> all(painting_width, painting_height, 1);
  const FilledPaint removed = remove_marked(picture, all, marked);
  EXPECT_EQ(removed.filled, 1600U);
  const auto mean_from = [&](int from) {
    double mean = 0.0;
    for (int y = 40; y < 80; ++y)
      for (int x = from; x < from + 10; ++x)
        mean += static_cast<double>(removed.picture(x, y).y) / 400.0;
    return mean;
  };
  // Flecks add about 1 of 255 to the meadow's 130. The light grows by .24 from the first ten
  // columns to the last, .125 in green.
  for (int from = 60; from < 100; from += 10)
    EXPECT_NEAR(mean_from(from), static_cast<double>(light(from + 5)) * 131.0 / 255.0, .07) << from;
  EXPECT_GT(mean_from(90) - mean_from(60), .07);
  EXPECT_LT(mean_from(90) - mean_from(60), .23);
}

TEST(RemoveMarked, FlatGroundStaysFlatAndWithoutGroundTheMarkStays) {
  Grid<glm::vec3> picture(80, 70, glm::vec3(.4F, .5F, .6F));
  Grid<std::uint8_t> marked(80, 70);
  for (int y = 30; y < 40; ++y)
    for (int x = 30; x < 50; ++x) {
      picture(x, y) = {1.F, 0.F, 0.F};
      marked(x, y) = 1;
    }
  Grid<std::uint8_t> counts(80, 70, 1);
  const FilledPaint removed = remove_marked(picture, counts, marked);
  EXPECT_EQ(removed.filled, 200U);
  for (const glm::vec3& c : removed.picture) {
    EXPECT_NEAR(c.x, .4F, .005F);
    EXPECT_NEAR(c.z, .6F, .005F);
  }
  // 40 × 50 pixels are less than 48 × 48.
  for (int y = 0; y < 70; ++y)
    for (int x = 0; x < 80; ++x) counts(x, y) = x < 40 && y < 50 ? 1 : 0;
  const FilledPaint kept = remove_marked(picture, counts, marked);
  EXPECT_EQ(kept.left, 200U);
  EXPECT_EQ(kept.picture, picture);
}

// Strokes about 3 wide and 15 long at `degrees` from the horizontal (clockwise, as y points down),
// with different lightness.
glm::vec3 stroke_at(int x, int y, double degrees, std::uint64_t seed) {
  const double a = degrees * std::numbers::pi / 180.0;
  const double along = std::cos(a) * x + std::sin(a) * y;
  const double across = -std::sin(a) * x + std::cos(a) * y;
  return glm::vec3(static_cast<float>(
      std::clamp(0.5 + 0.12 * gaussian_noise(seed, along / 5.0, across, 3.0), 0.0, 1.0)));
}

TEST(FindStrokeDirection, FollowsPaintedStrokesInEachLabel) {
  Grid<glm::vec3> picture(160, 100);
  Grid<std::uint8_t> labels(160, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 160; ++x) {
      labels(x, y) = x < 80 ? 1 : 2;
      picture(x, y) = stroke_at(x, y, x < 80 ? 60.0 : 110.0, 5) * (x < 80 ? 1.F : 0.4F);
    }
  const Grid<glm::vec2> direction = find_stroke_direction(picture, labels, 4.0);
  for (const auto& [from, degrees] : {std::pair{10, 60.0}, {90, 110.0}}) {
    double off = 0.0;
    int count = 0;
    int none = 0;
    for (int y = 8; y < 92; ++y)
      for (int x = from; x < from + 60; ++x) {
        const glm::vec2 d = direction(x, y);
        if (d == glm::vec2(0.F)) {
          ++none;
          continue;
        }
        ASSERT_NEAR(d.x * d.x + d.y * d.y, 1.F, 1e-4);
        ASSERT_GT(d.y, 0.F);
        off += std::abs(
            std::remainder(std::atan2(d.y, d.x) * 180.0 / std::numbers::pi - degrees, 180.0));
        ++count;
      }
    EXPECT_LT(off / count, 7.0) << degrees;
    EXPECT_LT(none, count / 10) << degrees;
  }
  // The border itself, a strong vertical edge, does not turn strokes.
  for (int y = 20; y < 80; ++y) EXPECT_LT(direction(82, y).x, 0.1F) << y;
}

TEST(FindStrokeDirection, LyingStrokesAndFlatPaintHaveNone) {
  Grid<glm::vec3> picture(80, 60);
  Grid<std::uint8_t> labels(80, 60, 1);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) picture(x, y) = x < 40 ? stroke_at(x, y, 3.0, 9) : glm::vec3(0.5F);
  const Grid<glm::vec2> direction = find_stroke_direction(picture, labels, 6.0);
  int steep = 0;
  for (int y = 5; y < 55; ++y)
    for (int x = 5; x < 30; ++x) steep += direction(x, y) != glm::vec2(0.F) ? 1 : 0;
  EXPECT_LT(steep, 50 * 25 / 10);
  EXPECT_EQ(direction(79, 30), glm::vec2(0.F));
}

}  // namespace

}  // namespace belvedere
