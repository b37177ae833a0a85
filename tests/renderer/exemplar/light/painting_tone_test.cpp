#include "renderer/exemplar/light/painting_tone.h"

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

// A slope of pale paint whose right half lies in shade, and in the shade a wood: it is no wood of
// all lights.
TEST(EstimateTone, ALabelInShadeAsAWholeIsNotTakenForALitOne) {
  Grid<std::uint8_t> labels(200, 80, 1);
  Grid<glm::vec3> picture(200, 80);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 200; ++x) {
      const bool shade = x >= 100, wood = x >= 140;
      const float variety = 0.04F * static_cast<float>(random_uniform(3, x / 10, y / 10) - 0.5);
      labels(x, y) = wood ? 2 : 1;
      picture(x, y) = (wood ? glm::vec3(0.3F, 0.4F, 0.25F) : glm::vec3(0.9F)) *
                      ((shade ? 0.6F : 1.F) + variety);
    }
  const Grid<float> tone = estimate_tone(picture, labels, 3.0);
  double lit = 0.0, shaded = 0.0, wood = 0.0;
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 60; ++x) {
      lit += tone(20 + x, y) / (80.0 * 60.0);
      shaded += x < 20 ? tone(110 + x, y) / (80.0 * 20.0) : 0.0;
      wood += tone(140 + x, y) / (80.0 * 60.0);
    }
  EXPECT_GT(lit, 0.75);
  EXPECT_LT(shaded, 0.5);
  EXPECT_NEAR(wood, shaded, 0.08);
}

TEST(EstimateTone, FlatPaintHasTheMiddleToneAndUnusedTexelsNone) {
  Grid<std::uint8_t> labels(20, 20, 4);
  labels(3, 3) = unused_label;
  const Grid<float> tone =
      estimate_tone(Grid<glm::vec3>(20, 20, glm::vec3(0.3F, 0.5F, 0.7F)), labels, 3.0);
  EXPECT_FLOAT_EQ(tone(10, 10), 0.64F);
  EXPECT_EQ(tone(3, 3), 0.F);
}

// A slope in light and shade whose place is known to some pixels only: the model's tone is that of
// the ground beside it. The wood lies in shade.
struct ModelledSlope {
  Grid<glm::vec3> picture{200, 80};
  Grid<std::uint8_t> labels{200, 80, 1};
  Grid<float> tone{200, 80}, modelled{200, 80}, altitude{200, 80}, depth{200, 80};
};

ModelledSlope paint_modelled_slope() {
  ModelledSlope s;
  const auto light_at = [](int x, int y) {
    const bool wood = x >= 140;
    return (wood ? 0.3 : 0.6) + (wood ? 0.05 : 0.25) * std::sin(0.11 * x) * std::cos(0.09 * y);
  };
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 200; ++x) {
      const bool wood = x >= 140;
      s.labels(x, y) = wood ? 2 : 1;
      s.depth(x, y) = 5000.F + 200.F * static_cast<float>(80 - y);
      s.altitude(x, y) = 1000.F + 5.F * static_cast<float>(80 - y);
      s.tone(x, y) = static_cast<float>(light_at(x, y));
      s.modelled(x, y) = static_cast<float>(light_at(wood ? std::max(x - 7, 140) : x - 7, y + 3));
      const double air = 0.3 * (80 - y) / 80.0;
      const double stroke = 0.1 * (random_uniform(5, x / 2, y / 2) - 0.5);
      s.picture(x, y) = glm::vec3(static_cast<float>(
          (wood ? 0.35 : 0.7) * (0.4 + 0.6 * light_at(x, y) + stroke) * (1.0 - air) + 0.7 * air));
    }
  return s;
}

double mean_error(const Grid<float>& tone, const Grid<float>& truth) {
  double sum = 0.0;
  for (std::size_t i = 0; i < tone.size(); ++i)
    sum += std::abs(static_cast<double>(tone[i] - truth[i])) / static_cast<double>(tone.size());
  return sum;
}

TEST(CombineTone, IsBetterThanPaintAndModelAlone) {
  const ModelledSlope s = paint_modelled_slope();
  const Grid<float> tone = combine_tone(s.picture, s.labels, 3.0, s.modelled, s.altitude, s.depth);
  const double error = mean_error(tone, s.tone);
  EXPECT_LT(error, 0.75 * mean_error(s.modelled, s.tone));
  EXPECT_LT(error, 0.4 * mean_error(estimate_tone(s.picture, s.labels, 3.0), s.tone));
  double wood = 0.0;
  for (int y = 0; y < 80; ++y)
    for (int x = 140; x < 200; ++x) wood += tone(x, y) / (80.0 * 60.0);
  EXPECT_NEAR(wood, 0.3, 0.03) << "one scale for all labels";
}

TEST(CombineTone, LeavesItToThePaintWherePlacesAreNotKnown) {
  const ModelledSlope s = paint_modelled_slope();
  Grid<float> modelled = s.modelled;
  Grid<float> deviation(200, 80, 0.F);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 20; ++x) {
      modelled(x, y) = 1.F - modelled(x, y);
      deviation(x, y) = 200.F;
    }
  const auto error = [&](const Grid<float>& off) {
    const Grid<float> tone =
        combine_tone(s.picture, s.labels, 3.0, modelled, s.altitude, s.depth, off);
    double sum = 0.0;
    for (int y = 0; y < 80; ++y)
      for (int x = 0; x < 20; ++x)
        sum += std::abs(static_cast<double>(tone(x, y) - s.tone(x, y))) / (80.0 * 20.0);
    return sum;
  };
  EXPECT_LT(error(deviation), 0.7 * error({}));
}

TEST(CombineTone, IsThePaintsWhereTheModelSaysSomethingElse) {
  ModelledSlope s = paint_modelled_slope();
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 200; ++x)
      s.modelled(x, y) = static_cast<float>(random_uniform(6, x / 5, y / 5));
  EXPECT_EQ(combine_tone(s.picture, s.labels, 3.0, s.modelled, s.altitude, s.depth),
            estimate_tone(s.picture, s.labels, 3.0));
}

// Seen against the sun: nearly all ground is in shade, the wood more than the meadow.
TEST(SpreadTone, HasTheQuartilesOfTargetsWhileTheOrderOfAllLabelsStays) {
  const Grid<std::uint8_t> labels = halves(100, 40);
  Grid<float> tone(100, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 100; ++x) {
      const double share = random_uniform(9, x, y);
      tone(x, y) = static_cast<float>(labels(x, y) == 1 ? 0.1 + 0.3 * share : 0.05 * share);
    }
  const Grid<float> out = spread_tone(tone, labels);
  std::vector<float> sorted(out.begin(), out.end());
  std::sort(sorted.begin(), sorted.end());
  EXPECT_NEAR(sorted[1000], 0.43F, 0.01F);
  EXPECT_NEAR(sorted[1999], 0.64F, 0.01F);
  EXPECT_NEAR(sorted[3000], 0.86F, 0.01F);
  for (std::size_t i = 1; i < out.size(); ++i) {
    if (tone[i] > tone[i - 1]) {
      EXPECT_GE(out[i], out[i - 1]) << i;
    }
    if (labels[i] == 2) {
      EXPECT_LE(out[i], 0.65F) << "the wood stays in shade";
    }
  }
}

TEST(SpreadTone, FlatLightIsTheMiddleToneAndUnusedTexelsKeepTheirs) {
  Grid<std::uint8_t> labels(10, 10, 3);
  labels(4, 4) = unused_label;
  const Grid<float> out = spread_tone(Grid<float>(10, 10, 0.1F), labels);
  EXPECT_FLOAT_EQ(out(0, 0), 0.64F);
  EXPECT_EQ(out(4, 4), 0.1F);
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
