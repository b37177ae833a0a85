#include "renderer/exemplar/fill_excluded.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/texture/statistical/texture_crops.h"
#include "texture/synthesis/guide_stack.h"

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

}  // namespace
}  // namespace belvedere
