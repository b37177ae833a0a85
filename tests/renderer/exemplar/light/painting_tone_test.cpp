#include "renderer/exemplar/light/painting_tone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/synthesize.h"

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

// Rock (label 7, left) and deep green forest (4, right) with strokes, and a shadow that falls over
// a slanted half of the rock.
struct Shaded {
  Grid<glm::vec3> picture{160, 120};
  Grid<std::uint8_t> labels{160, 120, 7};
  Grid<std::uint8_t> truth{160, 120, 0};
};

Shaded paint(glm::vec3 shade, std::uint64_t seed = 1, double slant = 0.5) {
  Shaded s;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) {
      const bool wood = x >= 100;
      s.labels(x, y) = wood ? 4 : 7;
      s.truth(x, y) = !wood && y > 40 + slant * x ? 1 : 0;
      const float stroke = 0.10F * static_cast<float>(random_uniform(seed, x / 2, y / 5) - 0.5);
      const glm::vec3 paint =
          wood ? glm::vec3(0.16F, 0.28F, 0.20F) : glm::vec3(0.70F, 0.66F, 0.60F);
      s.picture(x, y) =
          glm::clamp(paint * (s.truth(x, y) == 1 ? shade : glm::vec3(1.F)) + stroke, 0.F, 1.F);
    }
  return s;
}

const glm::vec3 blue_shade(0.55F, 0.62F, 0.80F);

TEST(FindShadow, OverlapsTheTrueShadow) {
  const Shaded s = paint(blue_shade);
  const Grid<float> shadow = find_shadow(s.picture, s.labels, 4.0);
  double both = 0.0;
  double either = 0.0;
  for (std::size_t i = 0; i < shadow.size(); ++i) {
    const bool found = shadow[i] < lit_from;
    both += found && s.truth[i] == 1 ? 1.0 : 0.0;
    either += found || s.truth[i] == 1 ? 1.0 : 0.0;
    if (s.labels[i] == 4) {
      ASSERT_EQ(shadow[i], 1.F) << "dark forest is not shaded";
    }
  }
  EXPECT_GT(both / either, 0.93);
}

TEST(FindShadow, DarkButNotCoolerIsNoCastShadow) {
  const Shaded s = paint(glm::vec3(0.60F, 0.55F, 0.45F));  // brown: other rock
  for (const float value : find_shadow(s.picture, s.labels, 4.0)) ASSERT_EQ(value, 1.F);
}

TEST(FindShadow, EvenPaintHasNone) {
  const Shaded s = paint(glm::vec3(1.F));
  for (const float value : find_shadow(s.picture, s.labels, 4.0)) ASSERT_EQ(value, 1.F);
}

Exemplar exemplar_of(const Shaded& s) {
  Exemplar exemplar{.name = "shaded", .picture = Grid<Rgb8>(160, 120), .guides = {}};
  for (std::size_t i = 0; i < s.picture.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      exemplar.picture[i][c] =
          static_cast<std::uint8_t>(std::lround(s.picture[i][static_cast<int>(c)] * 255.F));
  exemplar.guides.label = s.labels;
  return exemplar;
}

Grid<std::uint8_t> quantized(const Grid<float>& shadow) {
  Grid<std::uint8_t> values(shadow.width(), shadow.height());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<std::uint8_t>(std::lround(shadow[i] * 255.F));
  return values;
}

// The share of target pixels whose texel has the same true shadow.
TEST(FindShadow, ShadedGroundIsCopiedFromShadedGround) {
  const Shaded s = paint(blue_shade);
  Exemplar exemplar = exemplar_of(s);
  exemplar.guides.guides.push_back({"shadow", quantized(find_shadow(s.picture, s.labels, 4.0))});
  const Shaded other = paint(blue_shade, 2, -0.3);
  GuideStack target;
  target.label = other.labels;
  target.guides.push_back({"shadow", Grid<std::uint8_t>(160, 120)});
  for (std::size_t i = 0; i < other.truth.size(); ++i)
    target.guides[0].values[i] = other.truth[i] == 1 ? 0 : 255;
  const auto agreement = [&](double weight) {
    SynthesisParameters parameters;
    parameters.weights = {{"shadow", weight}};
    const MatchField matches = synthesize({exemplar}, target, parameters, silent_progress());
    double same = 0.0;
    for (std::size_t i = 0; i < matches.size(); ++i)
      same += s.truth(matches[i].x, matches[i].y) == other.truth[i] ? 1.0 : 0.0;
    return same / static_cast<double>(matches.size());
  };
  EXPECT_GT(agreement(1.0), 0.97);
  EXPECT_LT(agreement(0.0), 0.85);
}

// Four fifths of the rock lie in shade.
TEST(FindShadow, IsFoundWhereMostOfAClassIsShaded) {
  const Shaded s = paint(blue_shade, 1, -0.3);
  const Grid<float> shadow = find_shadow(s.picture, s.labels, 4.0);
  double right = 0.0;
  for (std::size_t i = 0; i < shadow.size(); ++i)
    right += (shadow[i] < lit_from) == (s.truth[i] == 1) ? 1.0 : 0.0;
  EXPECT_GT(right / static_cast<double>(shadow.size()), 0.95);
}

// A valley floor on the left, rock on the right, sky above: the blur has a deviation of one pixel.
TEST(FindValleyHeight, RisesFromLevelGroundAndLeavesOutTheSky) {
  Grid<std::uint8_t> labels(267, 60, 7);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 267; ++x)
      if (y < 20)
        labels(x, y) = unused_label;
      else if (x < 100)
        labels(x, y) = 2;
  const Grid<float> height = find_valley_height(labels);
  EXPECT_NEAR(height(50, 40), 0.F, 0.1F);
  // 30 % of what lies around the first pixel of rock is level: 60 ln .30 / ln .08.
  EXPECT_NEAR(height(100, 40), 28.6F, 3.F);
  EXPECT_NEAR(height(101, 40), 67.F, 8.F);
  EXPECT_EQ(height(150, 40), 600.F);
  EXPECT_NEAR(height(100, 20), height(100, 40), 0.5F) << "the sky is no ground";
}

TEST(FindValleyHeight, IsUnknownWithoutLevelGround) {
  EXPECT_TRUE(find_valley_height(Grid<std::uint8_t>(40, 30, 7)).empty());
}

}  // namespace

}  // namespace belvedere
