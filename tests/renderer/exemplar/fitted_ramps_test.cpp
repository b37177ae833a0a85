#include "renderer/exemplar/fitted_ramps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/random.h"
#include "renderer/exemplar/light/painting_tone.h"
#include "renderer/paint/base_picture.h"
#include "renderer/paint/composite.h"
#include "renderer/paint/guides.h"
#include "renderer/paint/light.h"
#include "tests/renderer/exemplar/painted_hills.h"
#include "texture/strokes/stroke_painter.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

const ToneRamp rock_ramp = {glm::vec3(0.26F, 0.30F, 0.45F),
                            {0.44F, 0.43F, 0.53F},
                            {0.69F, 0.65F, 0.63F},
                            {0.94F, 0.90F, 0.84F}};
const ToneRamp wood_ramp = {glm::vec3(0.12F, 0.24F, 0.35F),
                            {0.17F, 0.33F, 0.31F},
                            {0.28F, 0.44F, 0.31F},
                            {0.49F, 0.60F, 0.33F}};

glm::vec3 on_ramp(const ToneRamp& ramp, double tone) {
  std::size_t k = 0;
  while (k + 2 < ramp.size() && tone > ramp_tones[k + 1]) ++k;
  return glm::mix(ramp[k], ramp[k + 1],
                  static_cast<float>((tone - ramp_tones[k]) / (ramp_tones[k + 1] - ramp_tones[k])));
}

// Strokes over a known base: most of them ± .06 around it, every twelfth a white fleck that is not
// light.
struct Painted {
  Grid<glm::vec3> picture{120, 100};
  Grid<glm::vec3> base{120, 100};
  Grid<std::uint8_t> labels{120, 100};
  Grid<float> tone{120, 100};
  Grid<std::uint8_t> distance{120, 100};
};

Painted paint(double air) {
  Painted p;
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 120; ++x) {
      p.labels(x, y) = x < 60 ? 7 : 4;
      p.tone(x, y) = static_cast<float>(random_uniform(3, x, y));
      p.distance(x, y) = static_cast<std::uint8_t>(40 + 2 * y);
      const glm::vec3 colour = on_ramp(x < 60 ? rock_ramp : wood_ramp, p.tone(x, y));
      p.base(x, y) =
          glm::mix(colour, glm::vec3(0.7F, 0.8F, 0.9F), static_cast<float>(air * y / 100.0));
      const float stroke = 0.12F * static_cast<float>(random_uniform(4, x, y) - 0.5);
      p.picture(x, y) = random_uniform(5, x, y) < 0.08 ? glm::vec3(1.F) : p.base(x, y) + stroke;
    }
  return p;
}

double mean_error(const Grid<glm::vec3>& a, const Grid<glm::vec3>& b,
                  const Grid<std::uint8_t>& labels) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (labels[i] == unused_label) continue;
    const glm::vec3 d = glm::abs(a[i] - b[i]);
    sum += static_cast<double>(d.x + d.y + d.z) / 3.0;
    count += 1.0;
  }
  return sum / count;
}

TEST(FitRamps, FindsTheRampsUnderStrokesAndFlecks) {
  const Painted p = paint(0.0);
  const FittedRamps ramps = fit_ramps(p.picture, p.labels, p.tone, {});
  ASSERT_EQ(ramps[7].ramps.size(), 1U);
  for (std::size_t t = 0; t < ramp_tones.size(); ++t) {
    EXPECT_LT(glm::length(ramps[7].ramps[0][t] - rock_ramp[t]), 0.04F) << t;
    EXPECT_LT(glm::length(ramps[4].ramps[0][t] - wood_ramp[t]), 0.04F) << t;
  }
  EXPECT_EQ(ramps[7].texels, 6000U);
  EXPECT_TRUE(ramps[1].ramps.empty());
  EXPECT_LT(mean_error(make_ramp_base(ramps, p.picture, p.labels, p.tone, {}), p.base, p.labels),
            0.012);
}

// Flecks are a twelfth of the paint and no part of the ramps: the centred base is lighter by their
// share of lightness, and the paint has its mean.
TEST(FitRamps, ACentredBaseHasTheMeanOfThePaint) {
  const Painted p = paint(0.0);
  const FittedRamps ramps = fit_ramps(p.picture, p.labels, p.tone, {});
  const Grid<glm::vec3> plain = make_ramp_base(ramps, p.picture, p.labels, p.tone, {});
  const Grid<glm::vec3> centred = make_centred_base(ramps, p.picture, p.labels, p.tone, {});
  for (const std::uint8_t label : {std::uint8_t{4}, std::uint8_t{7}}) {
    double before = 0.0, after = 0.0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      if (p.labels[i] != label) continue;
      before += static_cast<double>(p.picture[i].y - plain[i].y) / 6000.0;
      after += static_cast<double>(p.picture[i].y - centred[i].y) / 6000.0;
    }
    EXPECT_GT(before, 0.015);
    EXPECT_NEAR(after, 0.0, 1e-5);
  }
}

TEST(FitRamps, AirIsFoundByDistance) {
  const Painted p = paint(0.6);
  const auto error = [&](const Grid<std::uint8_t>& distance) {
    return mean_error(make_ramp_base(fit_ramps(p.picture, p.labels, p.tone, distance), p.picture,
                                     p.labels, p.tone, distance),
                      p.base, p.labels);
  };
  EXPECT_LT(error(p.distance), 0.015);
  EXPECT_GT(error({}), 0.04);  // one ramp cannot hold it
  const LabelRamps near_and_far = fit_ramps(p.picture, p.labels, p.tone, p.distance)[4];
  EXPECT_EQ(near_and_far.distances.size(), 4U);
  EXPECT_NEAR(near_and_far.colour(0.5, 0.0).x, on_ramp(wood_ramp, 0.5).x,
              0.03);  // before the first distance
  EXPECT_NEAR(near_and_far.colour(0.5, 255.0).x, 0.4F * on_ramp(wood_ramp, 0.5).x + 0.6F * 0.7F,
              0.03);  // beyond the last
}

TEST(FitRamps, ToneThatIsNowhereGoesOnSmoothly) {
  Painted p = paint(0.0);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 120; ++x) {
      p.tone(x, y) = 0.4F + 0.2F * static_cast<float>(random_uniform(6, x, y));
      p.picture(x, y) = on_ramp(rock_ramp, p.tone(x, y));
    }
  const ToneRamp ramp = fit_ramps(p.picture, p.labels, p.tone, {})[7].ramps[0];
  for (std::size_t t = 0; t + 1 < ramp.size(); ++t) EXPECT_GT(ramp[t + 1].x, ramp[t].x) << t;
  for (const glm::vec3& colour : ramp)
    for (int c = 0; c < 3; ++c) EXPECT_TRUE(colour[c] >= 0.F && colour[c] <= 1.F);
}

TEST(FitRamps, UnusedTexelsCountNowhere) {
  Painted p = paint(0.0);
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 120; ++x) {
      p.labels(x, y) = unused_label;
      p.picture(x, y) = glm::vec3(1.F, 0.F, 0.F);  // lettering
    }
  const FittedRamps ramps = fit_ramps(p.picture, p.labels, p.tone, {});
  for (std::size_t t = 0; t < ramp_tones.size(); ++t)
    EXPECT_LT(glm::length(ramps[7].ramps[0][t] - rock_ramp[t]), 0.06F) << t;
  EXPECT_EQ(ramps[7].texels, 3000U);
  EXPECT_TRUE(ramps[unused_label].ramps.empty());
}

// A painting made by the program has an exact base picture, with air, mist between ranges and
// drifting hues: the estimate from its strokes and guides, or from strokes and classes alone, must
// come close to it.
TEST(FitRamps, RecoversTheBaseOfAPaintingOfTheProgramsOwn) {
  constexpr int width = 420;
  constexpr int height = 260;
  GuidanceBuffers guidance = test::make_hills(width, height);
  guidance.tone = make_tone(guidance, {}, {0, 0}, silent_progress());
  const BasePicture base =
      make_base_picture(guidance, read_palette("summer"), {.air = {.rim_fade_m = 0.0}, .water = {}},
                        {0, 0}, {width, height}, silent_progress());
  const Painting painting = paint_strokes(base.colour, guidance, base,
                                          {.sky = false, .upright = false}, {}, silent_progress());
  const PaintedClasses classes = find_painted_classes(painting.sources, guidance, base.colour);
  const GuideStack guides = make_guide_stack(guidance, classes.land_cover);
  const Grid<std::uint8_t>* distance = guides.find("distance");
  ASSERT_NE(distance, nullptr);
  const auto error = [&](const Grid<float>& tone, const Grid<std::uint8_t>& by_distance) {
    const FittedRamps ramps = fit_ramps(painting.picture, guides.label, tone, by_distance);
    return mean_error(make_ramp_base(ramps, painting.picture, guides.label, tone, by_distance),
                      classes.base, guides.label);
  };
  const double known = error(guidance.tone, *distance);
  const double estimated = error(estimate_tone(painting.picture, guides.label, 6.0), {});
  // The median of each class, which is the result without ramps.
  const double flat = error(Grid<float>(width, height, 0.64F), {});
  RecordProperty("known", std::to_string(known));
  RecordProperty("estimated", std::to_string(estimated));
  RecordProperty("flat", std::to_string(flat));
  // Fields, reflections in water and mist at the foot of ranges are in the base and not in any
  // ramp.
  EXPECT_LT(known, 0.05);
  EXPECT_LT(estimated, 0.06);
  EXPECT_LT(estimated, 0.65 * flat);
}

}  // namespace
}  // namespace belvedere
