#include "renderer/exemplar/light/shadow_texels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>

#include "base/random.h"
#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/guide_stack.h"
#include "texture/synthesis/synthesize.h"

namespace belvedere {
namespace {

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

// Of ground whose shadows lie some pixels off, the lit share of a region is right.
TEST(ShadowShare, IsThatOfTheRegion) {
  Grid<std::uint8_t> labels(160, 120, 7);
  Grid<float> shadow(160, 120, 1.F);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) {
      if (y < 30) labels(x, y) = unused_label;  // the sky
      if (x >= 80) shadow(x, y) = (x + y) % 4 == 0 ? 1.F : 0.F;
      if (y < 30) shadow(x, y) = 0.F;
    }
  const Grid<float> share = shadow_share(shadow, labels);
  EXPECT_NEAR(share(40, 31), 1.F, 1e-4F) << "the sky does not count";
  EXPECT_NEAR(share(120, 80), 0.25F, 0.03F);
  EXPECT_EQ(share(120, 10), 1.F);
}

}  // namespace
}  // namespace belvedere
