#include "renderer/exemplar/painting_tone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {
namespace {

Grid<std::uint8_t> halves(int width, int height) {
  Grid<std::uint8_t> labels(width, height, 1);
  for (int y = 0; y < height; ++y)
    for (int x = width / 2; x < width; ++x) labels(x, y) = 2;
  return labels;
}

// Light that rises from left to right under strokes, once in dark paint and once in light paint.
TEST(EstimateTone, FollowsTheLightOfEachLabelAndNotItsPaint) {
  constexpr int width = 240;
  constexpr int height = 80;
  const Grid<std::uint8_t> labels = halves(width, height);
  Grid<glm::vec3> picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float light = static_cast<float>(x % (width / 2)) / (width / 2);
      const float stroke = (y / 2) % 2 == 0 ? 0.04F : -0.04F;
      picture(x, y) =
          glm::vec3((labels(x, y) == 1 ? 0.1F + 0.3F * light : 0.6F + 0.3F * light) + stroke);
    }
  const Grid<float> tone = estimate_tone(picture, labels, 6.0);
  for (const int left : {0, width / 2})
    for (const auto& [share, expected] : {std::pair{0.25, 0.43}, {0.5, 0.64}, {0.75, 0.86}})
      EXPECT_NEAR(tone(left + static_cast<int>(share * width / 2), height / 2), expected, 0.02)
          << left;
  // Strokes leave hardly a trace.
  for (int x = 0; x < width; ++x) EXPECT_NEAR(tone(x, 40), tone(x, 42), 0.02) << x;
  // … but they do where they count as light.
  const Grid<float> fine = estimate_tone(picture, labels, 0.5);
  EXPECT_GT(std::abs(fine(60, 40) - fine(60, 42)), 0.1);
}

TEST(EstimateTone, FlatPaintHasTheMiddleToneAndUnusedTexelsNone) {
  Grid<std::uint8_t> labels(20, 20, 4);
  labels(3, 3) = unused_label;
  const Grid<float> tone =
      estimate_tone(Grid<glm::vec3>(20, 20, glm::vec3(0.3F, 0.5F, 0.7F)), labels, 3.0);
  EXPECT_FLOAT_EQ(tone(10, 10), 0.64F);
  EXPECT_EQ(tone(3, 3), 0.F);
}

TEST(EstimateTone, SameBitsForOneAndTwoThreads) {
  Grid<glm::vec3> picture(70, 50);
  for (std::size_t i = 0; i < picture.size(); ++i)
    picture[i] = glm::vec3(static_cast<float>(random_uniform(1, static_cast<std::int64_t>(i), 0)));
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return estimate_tone(picture, halves(70, 50), 4.0);
  };
  EXPECT_EQ(with(1), with(2));
}

}  // namespace
}  // namespace belvedere
