#include "renderer/exemplar/harmonize.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/image/srgb.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

TEST(Oklab, KnownValuesAndRoundTrip) {
  // Björn Ottosson's own implementation, six digits.
  const glm::dvec3 red = to_oklab({1.F, 0.F, 0.F});
  EXPECT_NEAR(red.x, 0.627955, 1e-5);
  EXPECT_NEAR(red.y, 0.224863, 1e-5);
  EXPECT_NEAR(red.z, 0.125846, 1e-5);
  const glm::dvec3 white = to_oklab({1.F, 1.F, 1.F});
  EXPECT_NEAR(white.x, 1.0, 1e-5);
  EXPECT_NEAR(white.y, 0.0, 1e-5);
  for (int i = 0; i < 50; ++i) {
    const glm::vec3 rgb{static_cast<float>(random_uniform(1, i, 0)),
                        static_cast<float>(random_uniform(1, i, 1)),
                        static_cast<float>(random_uniform(1, i, 2))};
    EXPECT_LT(glm::length(from_oklab(to_oklab(rgb)) - rgb), 1e-5F);
  }
}

// A painting whose label 1 stands left, 2 right, with colours normal about a mean, spread along a
// slanted axis.
struct Painting2 {
  Grid<glm::vec3> picture{80, 60};
  Grid<std::uint8_t> labels{80, 60, 1};
  LabelledPicture view() const { return {&picture, &labels}; }
};

Painting2 make(std::uint64_t seed, glm::dvec3 mean_1, glm::dvec3 mean_2, double spread) {
  Painting2 p;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) {
      if (x >= 40) p.labels(x, y) = 2;
      const double a = random_normal(seed, x, y, 0);
      const double b = random_normal(seed, x, y, 1);
      const glm::dvec3 lab =
          (x < 40 ? mean_1 : mean_2) + spread * glm::dvec3(a, 0.3 * a + 0.1 * b, 0.25 * b);
      p.picture(x, y) = from_oklab(lab);
    }
  return p;
}

glm::dvec3 mean_of(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                   std::uint8_t label) {
  glm::dvec3 sum(0.0);
  double count = 0.0;
  for (std::size_t i = 0; i < picture.size(); ++i)
    if (labels[i] == label) {
      sum += to_oklab(picture[i]);
      count += 1.0;
    }
  return sum / count;
}

const Painting2 warm = make(1, {0.55, 0.03, 0.05}, {0.75, 0.01, 0.03}, 0.03);
const Painting2 cool = make(2, {0.45, -0.02, -0.03}, {0.6, -0.02, -0.02}, 0.06);

TEST(Harmonize, TheReferenceStaysAndTheOtherBecomesLikeIt) {
  const auto out = harmonize({warm.view(), cool.view()}, 0);
  EXPECT_EQ(out[0], warm.picture);
  const LabelledPicture changed{&out[1], &cool.labels};
  for (const std::uint8_t label : {1, 2}) {
    const double before = colour_distance(warm.view(), cool.view(), label);
    const double after = colour_distance(warm.view(), changed, label);
    EXPECT_GT(before, 0.04) << int{label};
    EXPECT_LT(after, 0.005) << int{label};
  }
}

TEST(Harmonize, CommonLooksMeetInTheMiddle) {
  const auto out = harmonize({warm.view(), cool.view()}, std::nullopt);
  for (const std::uint8_t label : {1, 2}) {
    const glm::dvec3 centre = 0.5 * (mean_of(warm.picture, warm.labels, label) +
                                     mean_of(cool.picture, cool.labels, label));
    EXPECT_LT(glm::length(mean_of(out[0], warm.labels, label) - centre), 0.006) << int{label};
    EXPECT_LT(glm::length(mean_of(out[1], cool.labels, label) - centre), 0.006) << int{label};
    EXPECT_LT(colour_distance({&out[0], &warm.labels}, {&out[1], &cool.labels}, label), 0.005)
        << int{label};
  }
}

TEST(Harmonize, PaintingsThatAreAlikeStayAsTheyAre) {
  const auto out = harmonize({warm.view(), warm.view()}, std::nullopt);
  for (std::size_t i = 0; i < out[1].size(); ++i)
    ASSERT_LT(glm::length(out[1][i] - warm.picture[i]), 1e-4F);
}

TEST(Harmonize, AClassThatOnePaintingHasAloneGoesAlong) {
  Painting2 alone = cool;
  for (std::uint8_t& label : alone.labels)
    if (label == 2) label = 9;
  const auto out = harmonize({warm.view(), alone.view()}, 0);
  const glm::dvec3 shift_1 =
      mean_of(warm.picture, warm.labels, 1) - mean_of(cool.picture, cool.labels, 1);
  const glm::dvec3 shift_9 =
      mean_of(out[1], alone.labels, 9) - mean_of(cool.picture, cool.labels, 2);
  EXPECT_LT(glm::length(shift_9 - shift_1), 0.01);
}

TEST(Harmonize, UnusedTexelsAreNeitherCountedNorChanged) {
  Painting2 framed = cool;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 10; ++x) {
      framed.labels(x, y) = unused_label;
      framed.picture(x, y) = glm::vec3(1.F, 0.8F, 0.F);  // a gilded frame
    }
  const auto out = harmonize({warm.view(), framed.view()}, 0);
  EXPECT_EQ(out[1](3, 3), framed.picture(3, 3));
  EXPECT_LT(colour_distance(warm.view(), {&out[1], &framed.labels}, 1), 0.006);
}

TEST(Harmonize, SpreadGrowsAtMostThreefold) {
  const Painting2 faint = make(3, {0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}, 0.012);
  const Painting2 strong = make(4, {0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}, 0.09);
  const auto out = harmonize({strong.view(), faint.view()}, 0);
  double spread = 0.0;
  const glm::dvec3 mean = mean_of(out[1], faint.labels, 1);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 35; ++x)
      spread += std::pow(to_oklab(out[1](x, y)).x - mean.x, 2.0) / (35 * 60);
  EXPECT_NEAR(std::sqrt(spread), 0.036, 0.003);
}

TEST(Harmonize, RefusesAReferenceThatIsNotThereAndOtherSizes) {
  EXPECT_THROW(harmonize({warm.view()}, 1), Error);
  EXPECT_THROW(harmonize_as("loud", {warm.view()}), Error);
  const Grid<std::uint8_t> small(3, 3, 1);
  EXPECT_THROW(harmonize({{&warm.picture, &small}}, std::nullopt), Error);
}

TEST(Harmonize, SameBitsForOneAndTwoThreads) {
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return harmonize({warm.view(), cool.view()}, std::nullopt);
  };
  EXPECT_EQ(with(1)[1], with(2)[1]);
}

// Region by region to the first painting; ignored pixels stay.
TEST(Harmonize, ByRegionsAllButTheFirstChange) {
  Grid<glm::vec3> green(60, 50);
  Grid<glm::vec3> brown(60, 50);
  Grid<std::uint8_t> labels(60, 50, 7);
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 60; ++x) {
      const float light = .6F + .015F * static_cast<float>((3 * x + 5 * y) % 20);
      green(x, y) = light * glm::vec3(.3F, .8F, .2F);
      brown(x, y) = light * glm::vec3(.7F, .4F, .2F);
      if (y < 5) labels(x, y) = unused_label;
    }
  const std::vector<Grid<glm::vec3>> out =
      harmonize_as("regions", {{&green, &labels}, {&brown, &labels}});
  ASSERT_EQ(out.size(), 2U);
  EXPECT_EQ(out[0], green);
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 60; ++x) {
      if (y < 5) {
        ASSERT_EQ(out[1](x, y), brown(x, y));
      } else {
        ASSERT_GT(out[1](x, y).y, 1.5F * out[1](x, y).x) << "green by now, at " << x << ", " << y;
      }
    }
  const std::vector<Grid<glm::vec3>> off =
      harmonize_as("off", {{&green, &labels}, {&brown, &labels}});
  EXPECT_EQ(off[1], brown);
}

}  // namespace
}  // namespace belvedere
