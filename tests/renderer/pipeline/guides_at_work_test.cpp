// All guides together, at the weights that a painting gets, on made paintings: where texels come
// from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "renderer/pipeline/copy_plan.h"
#include "tests/scenes.h"
#include "texture/synthesis/synthesize.h"

namespace belvedere {
namespace {

constexpr std::uint8_t woods = 8;
constexpr std::uint8_t meadow = 3;

// Smooth noise 0…1 with features of about `scale` pixels.
double smooth(std::uint64_t seed, double x, double y, double scale) {
  const double u = x / scale + 2.0;
  const double v = y / scale + 2.0;
  const int i = static_cast<int>(u);
  const int j = static_cast<int>(v);
  const auto ease = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double a = ease(u - i);
  const double b = ease(v - j);
  const auto corner = [&](int p, int q) { return random_uniform(seed, i + p, j + q); };
  return (corner(0, 0) * (1 - a) + corner(1, 0) * a) * (1 - b) +
         (corner(0, 1) * (1 - a) + corner(1, 1) * a) * b;
}

// Ground of two classes with eight guides: distance falls from above, shadow lies on slopes away
// from the light and under clouds, valleys are where the relief is low.
GuideStack ground(int size, std::uint64_t seed) {
  GuideStack stack;
  stack.label = Grid<std::uint8_t>(size, size);
  for (const char* name :
       {"altitude", "tone", "distance", "shadow", "slope", "fall_line_x", "fall_line_y", "valley"})
    stack.guides.push_back({name, Grid<std::uint8_t>(size, size)});
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double up = 1.0 - static_cast<double>(y) / size;
      const double relief = smooth(seed, x, y, 48);
      const double gx = 12.0 * (smooth(seed + 1, x + 1, y, 24) - smooth(seed + 1, x - 1, y, 24));
      const double gy = 12.0 * (smooth(seed + 1, x, y + 1, 24) - smooth(seed + 1, x, y - 1, 24));
      const double steep = std::hypot(gx, gy) + 1e-6;
      const double light = 0.55 + 0.45 * (0.7 * gx - 0.5 * gy);
      const bool shaded = light < 0.3 || smooth(seed + 2, x, y, 30) < 0.22;
      const double values[] = {0.8 * (0.15 + 0.35 * relief + 0.1 * up),
                               shaded ? 0.4 * light : light,
                               0.27 + 0.34 * up + 0.045 * (smooth(seed + 3, x, y, 40) - 0.5),
                               shaded ? 0.0 : 1.0,
                               steep / 1.5,
                               0.5 + 0.5 * gx / steep,
                               0.5 + 0.5 * gy / steep,
                               1.6 * (relief - 0.25)};
      for (std::size_t g = 0; g < stack.guides.size(); ++g)
        stack.guides[g].values(x, y) =
            static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(values[g], 0.0, 1.0)));
      stack.label(x, y) = smooth(seed + 4, x, y, 60) < 0.55 ? woods : meadow;
    }
  return stack;
}

// Strokes along the fall line, shorter and fainter far away; lightness follows light, shadow,
// distance and valleys.
Exemplar painted(int size, std::uint64_t seed) {
  Exemplar exemplar{
      .name = "made painting", .picture = Grid<Rgb8>(size, size), .guides = ground(size, seed)};
  const GuideStack& guides = exemplar.guides;
  const auto share = [&](const char* name, int x, int y) {
    return (*guides.find(name))(x, y) / 255.0;
  };
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const double far = share("distance", x, y);
      const int reach = static_cast<int>(std::clamp(14.0 - 22.0 * (far - 0.2), 3.0, 14.0) / 2.0);
      double stroke = 0.0;
      for (int t = -reach; t <= reach; ++t) {
        const int i = x + static_cast<int>(std::lround(t * (2 * share("fall_line_x", x, y) - 1)));
        const int j = y + static_cast<int>(std::lround(t * (2 * share("fall_line_y", x, y) - 1)));
        stroke += random_uniform(seed + 9, i + 100, j + 100) - 0.5;
      }
      stroke /= std::sqrt(2.0 * reach + 1.0);
      const double lightness =
          105.0 + 96.0 * (1.15 - far) * stroke + 22.0 * (share("tone", x, y) - 0.5) -
          12.0 * (1.0 - share("shadow", x, y)) + 15.0 * (far - 0.4) -
          15.0 * (1.0 - share("valley", x, y)) + (guides.label(x, y) == woods ? -20.0 : 20.0);
      for (std::size_t c = 0; c < 3; ++c)
        exemplar.picture(x, y)[c] = static_cast<std::uint8_t>(
            std::clamp(lightness + 8.0 * static_cast<double>(c), 0.0, 255.0));
    }
  return exemplar;
}

// Ranks, the mean rank of equal values.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> out;
  for (const double v : values) {
    const auto [from, to] = std::equal_range(sorted.begin(), sorted.end(), v);
    out.push_back(static_cast<double>((from - sorted.begin()) + (to - sorted.begin())) / 2.0);
  }
  return out;
}

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> p = ranks(a);
  const std::vector<double> q = ranks(b);
  const double n = static_cast<double>(p.size());
  double sp = 0, sq = 0, spp = 0, sqq = 0, spq = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    sp += p[i];
    sq += q[i];
    spp += p[i] * p[i];
    sqq += q[i] * q[i];
    spq += p[i] * q[i];
  }
  return (spq - sp * sq / n) / std::sqrt((spp - sp * sp / n) * (sqq - sq * sq / n));
}

// Requested and copied values of a guide, of one class or (label 0) of all.
std::pair<std::vector<double>, std::vector<double>> asked_and_taken(const MatchField& field,
                                                                    const Exemplar& exemplar,
                                                                    const GuideStack& target,
                                                                    const char* guide,
                                                                    std::uint8_t label = 0) {
  std::pair<std::vector<double>, std::vector<double>> out;
  const Grid<std::uint8_t>& asked = *target.find(guide);
  const Grid<std::uint8_t>& offered = *exemplar.guides.find(guide);
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (label != 0 && target.label[i] != label) continue;
    out.first.push_back(asked[i]);
    out.second.push_back(offered(field[i].x, field[i].y));
  }
  return out;
}

// Of the pixels that ask for less than `low`, the share that took less than `limit`.
double low_from_low(const std::pair<std::vector<double>, std::vector<double>>& values, double low,
                    double limit) {
  double asking = 0.0;
  double met = 0.0;
  for (std::size_t i = 0; i < values.first.size(); ++i) {
    if (values.first[i] >= low) continue;
    asking += 1.0;
    met += values.second[i] < limit ? 1.0 : 0.0;
  }
  EXPECT_GT(asking, 500.0);
  return met / asking;
}

double shadow_agreement(const std::pair<std::vector<double>, std::vector<double>>& values) {
  double same = 0.0;
  for (std::size_t i = 0; i < values.first.size(); ++i)
    same += (values.first[i] < 128.0) == (values.second[i] < 128.0) ? 1.0 : 0.0;
  return same / static_cast<double>(values.first.size());
}

TEST(GuidesAtWork, ARegisteredPaintingGivesDistanceShadowAndValleys) {
  const Exemplar exemplar = painted(192, 1);
  const GuideStack target = ground(128, 100);
  const SynthesisParameters parameters =
      fit_to_paintings(test::small_scene().scene, {exemplar}, silent_progress());
  const MatchField field = synthesize({exemplar}, target, parameters, silent_progress());
  const auto distance = asked_and_taken(field, exemplar, target, "distance", woods);
  const double correlation = rank_correlation(distance.first, distance.second);
  RecordProperty("distance_of_woods", std::to_string(correlation));
  EXPECT_GT(correlation, 0.5);
  const auto shadow = asked_and_taken(field, exemplar, target, "shadow");
  EXPECT_GT(shadow_agreement(shadow), 0.8);
  EXPECT_GT(low_from_low(shadow, 128.0, 128.0), 0.8) << "shaded ground from shaded paint";
  EXPECT_GT(low_from_low(asked_and_taken(field, exemplar, target, "valley"), 64.0, 110.0), 0.7)
      << "valleys from valleys";
}

// A painting with a mask only has tone, shadow and the direction of strokes.
TEST(GuidesAtWork, APaintingWithAMaskGivesShadow) {
  Exemplar exemplar = painted(192, 1);
  GuideStack target = ground(128, 100);
  std::erase_if(exemplar.guides.guides, [](const Guide& guide) {
    return guide.name != "tone" && guide.name != "shadow" && !guide.name.starts_with("fall_line");
  });
  const SynthesisParameters parameters =
      fit_to_paintings(test::small_scene().scene, {exemplar}, silent_progress());
  const MatchField field = synthesize({exemplar}, target, parameters, silent_progress());
  const auto shadow = asked_and_taken(field, exemplar, target, "shadow");
  EXPECT_GT(shadow_agreement(shadow), 0.8);
  EXPECT_GT(low_from_low(shadow, 128.0, 128.0), 0.8);
}

}  // namespace
}  // namespace belvedere
