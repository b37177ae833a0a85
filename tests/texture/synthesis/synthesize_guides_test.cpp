// The effect of guides, levels and further paintings on the texture, measured in the picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/texture/synthesis/synthetic_land.h"
#include "texture/quality/quality.h"
#include "texture/synthesis/match_cost.h"
#include "texture/synthesis/synth_setup.h"
#include "texture/synthesis/synthesize.h"

namespace belvedere {
namespace {

using namespace test;

Rgb8 grey(int value) {
  const auto v = static_cast<std::uint8_t>(std::clamp(value, 0, 255));
  return {v, v, v};
}

Grid<Rgb8> copied(const MatchField& field, const std::vector<Exemplar>& exemplars) {
  std::vector<const Grid<Rgb8>*> layers;
  for (const Exemplar& exemplar : exemplars) layers.push_back(&exemplar.picture);
  return replay(field, layers, Grid<Rgb8>());
}

// Mean step of grey from pixel to pixel along rows y0 … y1 - 1: large for short strokes, small for
// long ones.
double step_along_rows(const Grid<Rgb8>& picture, int y0, int y1) {
  double sum = 0.0;
  int count = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = 1; x < picture.width(); ++x, ++count)
      sum += std::abs(picture(x, y)[1] - picture(x - 1, y)[1]);
  return sum / count;
}

// One class, one painter: long strokes near (below), short ones far away (above). The guide is the
// distance; it is reversed in the target, whose upper half is near.
TEST(SynthesizeGuides, TextureChangesWithDistance) {
  const auto distance_guide = [](int width, int height, bool near_above) {
    Grid<std::uint8_t> values(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        values(x, y) =
            static_cast<std::uint8_t>(255 * (near_above ? y : height - 1 - y) / (height - 1));
    return values;
  };
  Exemplar exemplar;
  exemplar.name = "near and far";
  exemplar.picture = Grid<Rgb8>(160, 160);
  exemplar.guides.label = Grid<std::uint8_t>(160, 160, 3);
  exemplar.guides.guides = {{"distance", distance_guide(160, 160, false)}};
  for (int y = 0; y < 160; ++y) {
    const int length = 2 + 14 * y / 160;
    for (int x = 0; x < 160; ++x)
      exemplar.picture(x, y) =
          grey(60 + static_cast<int>(random_index(130, 5, (x + 3 * y) / length, y)));
  }
  GuideStack target;
  target.label = Grid<std::uint8_t>(128, 128, 3);
  target.guides = {{"distance", distance_guide(128, 128, true)}};
  const auto near_to_far = [&](double weight) {
    SynthesisParameters parameters;
    parameters.weights = {{"distance", weight}};
    const Grid<Rgb8> picture = copied(run({exemplar}, target, parameters), {exemplar});
    return step_along_rows(picture, 0, 40) / step_along_rows(picture, 88, 128);
  };
  const double in_painting =
      step_along_rows(exemplar.picture, 110, 160) / step_along_rows(exemplar.picture, 0, 50);
  EXPECT_LT(in_painting, 0.5);
  EXPECT_LT(near_to_far(1.0), 0.5);
  EXPECT_GT(near_to_far(0.0), 0.8) << "without the guide near and far are the same";
}

// Patterns larger than a patch come from coarser levels; a single level misses them, and its seams
// cost more.
TEST(SynthesizeGuides, CoarserLevelsSaveSeams) {
  Exemplar exemplar;
  exemplar.name = "swells";
  exemplar.picture = Grid<Rgb8>(200, 200);
  exemplar.guides.label = Grid<std::uint8_t>(200, 200, 3);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x)
      exemplar.picture(x, y) =
          grey(smooth_noise(3, x, y, 24) * 3 / 4 + static_cast<int>(random_index(50, 4, x / 4, y)));
  GuideStack target;
  target.label = Grid<std::uint8_t>(128, 128, 3);
  const auto seams = [&](int levels) {
    SynthesisParameters parameters;
    parameters.levels = levels;
    const Grid<float> cost =
        seam_cost(run({exemplar}, target, parameters), {exemplar}, target.label, {});
    double sum = 0.0;
    for (const float c : cost) sum += static_cast<double>(c);
    return sum / static_cast<double>(cost.size());
  };
  const double one = seams(1);
  const double many = seams(6);
  RecordProperty("one_level", std::to_string(one));
  RecordProperty("many_levels", std::to_string(many));
  EXPECT_LT(many, 0.85 * one);
}

// A second painting of the same style halves the pixels per texel.
TEST(SynthesizeGuides, ASecondPaintingLowersReuse) {
  const std::vector<Exemplar> one{painting(90, 90, 1)};
  const std::vector<Exemplar> two{one[0], painting(90, 90, 2)};
  const GuideStack target = land(160, 160, 40);
  // How often the texel of a pixel is used, on average over pixels.
  const auto uses = [&](const std::vector<Exemplar>& exemplars) {
    const MatchField field = run(exemplars, target);
    const std::vector<Grid<std::uint32_t>> of = texel_uses(field, exemplars);
    double sum = 0.0;
    for (const Match& m : field) sum += of[m.exemplar](m.x, m.y);
    return sum / static_cast<double>(field.size());
  };
  const double alone = uses(one);
  const double shared = uses(two);
  RecordProperty("one_painting", std::to_string(alone));
  RecordProperty("two_paintings", std::to_string(shared));
  EXPECT_LT(shared, 0.65 * alone);
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double n = static_cast<double>(a.size());
  double sa = 0.0, sb = 0.0, saa = 0.0, sbb = 0.0, sab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sa += a[i];
    sb += b[i];
    saa += a[i] * a[i];
    sbb += b[i] * b[i];
    sab += a[i] * b[i];
  }
  return (sab - sa * sb / n) / std::sqrt((saa - sa * sa / n) * (sbb - sb * sb / n));
}

// A ramp of altitude from left to right, up to `highest`.
Grid<std::uint8_t> altitude_ramp(int width, int height, int highest) {
  Grid<std::uint8_t> values(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      values(x, y) = static_cast<std::uint8_t>(highest * x / (width - 1));
  return values;
}

// An exemplar without the altitude keeps the others' altitude, and serves where they have none: the
// complete one was painted at the lower half of the altitudes asked for.
TEST(SynthesizeGuides, APoorExemplarLeavesTheOthersTheirGuides) {
  std::vector<Exemplar> both(2);
  for (std::size_t e = 0; e < 2; ++e) {
    both[e].name = e == 0 ? "complete" : "without altitude";
    both[e].picture = Grid<Rgb8>(160, 160);
    both[e].guides.label = Grid<std::uint8_t>(160, 160, 3);
    for (int y = 0; y < 160; ++y)
      for (int x = 0; x < 160; ++x)
        both[e].picture(x, y) = grey(60 + static_cast<int>(random_index(130, 5 + e, x / 4, y)));
  }
  both[0].guides.guides = {{"altitude", altitude_ramp(160, 160, 127)}};
  GuideStack target;
  target.label = Grid<std::uint8_t>(128, 128, 3);
  target.guides = {{"altitude", altitude_ramp(128, 128, 255)}};
  const Grid<std::uint8_t>& source = both[0].guides.guides[0].values;
  const Grid<std::uint8_t>& asked = target.guides[0].values;
  // Of pixels that ask for low … high: the share of the exemplar without altitude, and the
  // correlation of altitudes over the others.
  const auto look = [&](const MatchField& field, int low, int high) {
    std::vector<double> requested, offered;
    double count = 0.0;
    for (std::size_t i = 0; i < field.size(); ++i) {
      if (asked[i] < low || asked[i] > high) continue;
      count += 1.0;
      if (field[i].exemplar != 0) continue;
      requested.push_back(asked[i]);
      offered.push_back(source(field[i].x, field[i].y));
    }
    return std::pair{1.0 - static_cast<double>(requested.size()) / count,
                     correlation(requested, offered)};
  };
  for (const double weight : {1.0, 0.004}) {
    SynthesisParameters parameters;
    parameters.weights = {{"altitude", weight}};
    SynthesisNotes notes;
    const MatchField field = synthesize(both, target, parameters, notes);
    ASSERT_EQ(notes.notes.size(), 1U);
    EXPECT_NE(notes.notes[0].find("altitude"), std::string::npos);
    const double alone = look(run({both[0]}, target, parameters), 0, 120).second;
    const auto [share, together] = look(field, 0, 120);
    EXPECT_GT(alone, 0.9);
    EXPECT_GT(together, 0.93 * alone) << weight;
    EXPECT_LT(share, 0.9);
    EXPECT_GT(share, weight < 1.0 ? 0.02 : -1.0) << "where its paint fits better";
    EXPECT_GT(look(field, 220, 255).first, 0.5) << "the complete one has none of these altitudes";
  }
}

// The price of a lacked guide: values 10 and 30 in equal numbers have variance 100, so the mean
// square of the difference of two random ones is 200, at 270 each.
TEST(SynthesizeGuides, ALackedGuideCostsARandomDifference) {
  std::vector<Exemplar> both(2);
  for (Exemplar& exemplar : both) {
    exemplar.name = "half";
    exemplar.picture = Grid<Rgb8>(20, 20);
    exemplar.guides.label = Grid<std::uint8_t>(20, 20, 3);
  }
  both[0].guides.guides = {{"altitude", Grid<std::uint8_t>(20, 20, 10)}};
  for (int i = 0; i < 200; ++i)
    both[0].guides.guides[0].values[static_cast<std::size_t>(2 * i)] = 30;
  both[1].guides.label(0, 0) = 5;  // a class of its own: the price of all classes
  GuideStack target;
  target.label = Grid<std::uint8_t>(20, 20, 3);
  target.guides = {{"altitude", Grid<std::uint8_t>(20, 20, 20)}};
  const synth::Setup setup = synth::make_setup(both, target, {}, 1, silent_progress());
  const synth::Plane plane = synth::halve(synth::exemplar_plane(both, setup));
  ASSERT_EQ(plane.lacking_price.size(), 512U);
  EXPECT_EQ(plane.lacking_price[0], 0);
  EXPECT_EQ(plane.lacking_price[256], 270 * 200);
  EXPECT_EQ(plane.lacking_price[257], 270 * 200);
  EXPECT_TRUE(plane.knows(0, 0));
  EXPECT_FALSE(plane.knows(1, 0));
  EXPECT_TRUE(synth::exemplar_plane({both[0]}, setup).known.empty());
}

// The direction of strokes at a position, 0 … π, from the structure of grey around it, and its
// certainty 0 … 1.
struct Direction {
  double angle = 0.0;
  double certainty = 0.0;
};
Direction stroke_direction(const Grid<Rgb8>& picture, int x, int y) {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (int j = y - 5; j <= y + 5; ++j)
    for (int i = x - 5; i <= x + 5; ++i) {
      const double gx = picture.clamped(i + 1, j)[1] - picture.clamped(i - 1, j)[1];
      const double gy = picture.clamped(i, j + 1)[1] - picture.clamped(i, j - 1)[1];
      xx += gx * gx;
      xy += gx * gy;
      yy += gy * gy;
    }
  const double across = 0.5 * std::atan2(2.0 * xy, xx - yy);  // of the strongest change
  const double total = xx + yy;
  return {std::fmod(across + 1.5 * std::numbers::pi, std::numbers::pi),
          total > 0.0 ? std::hypot(xx - yy, 2.0 * xy) / total : 0.0};
}

// Strokes in sixteen directions; fall lines are unit vectors as in renderer/paint/guides.h.
void fill_direction(GuideStack& stack, int x, int y, double angle) {
  stack.guides[0].values(x, y) =
      static_cast<std::uint8_t>(std::lround(127.5 + 127.5 * std::cos(angle)));
  stack.guides[1].values(x, y) =
      static_cast<std::uint8_t>(std::lround(127.5 + 127.5 * std::sin(angle)));
}

// Strokes along the fall line in the painting run along the fall line in the picture, here around a
// round hill.
TEST(SynthesizeGuides, CopiedStrokesFollowTheFallLine) {
  constexpr int panel = 48;
  Exemplar exemplar;
  exemplar.name = "slopes of all directions";
  exemplar.picture = Grid<Rgb8>(8 * panel, 2 * panel);
  exemplar.guides.label = Grid<std::uint8_t>(8 * panel, 2 * panel, 3);
  exemplar.guides.guides = {{"fall_line_x", Grid<std::uint8_t>(8 * panel, 2 * panel)},
                            {"fall_line_y", Grid<std::uint8_t>(8 * panel, 2 * panel)}};
  for (int y = 0; y < 2 * panel; ++y)
    for (int x = 0; x < 8 * panel; ++x) {
      const double angle = std::numbers::pi / 8.0 * (x / panel + 8 * (y / panel));
      const double along = std::cos(angle) * x + std::sin(angle) * y;
      const double across = -std::sin(angle) * x + std::cos(angle) * y;
      exemplar.picture(x, y) =
          grey(70 + static_cast<int>(
                        random_index(120, 9, static_cast<int>(std::floor(along / 14.0)) + 5000,
                                     static_cast<int>(std::floor(across / 2.0)) + 5000)));
      fill_direction(exemplar.guides, x, y, angle);
    }
  GuideStack target;
  target.label = Grid<std::uint8_t>(128, 128, 3);
  target.guides = {{"fall_line_x", Grid<std::uint8_t>(128, 128)},
                   {"fall_line_y", Grid<std::uint8_t>(128, 128)}};
  const auto fall_line = [](int x, int y) { return std::atan2(y - 63.5, x - 63.5); };
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) fill_direction(target, x, y, fall_line(x, y));
  const auto mean_error_deg = [&](double weight) {
    SynthesisParameters parameters;
    parameters.weights = {{"fall_line_x", weight}, {"fall_line_y", weight}};
    const Grid<Rgb8> picture = copied(run({exemplar}, target, parameters), {exemplar});
    double sum = 0.0;
    double weights = 0.0;
    for (int y = 8; y < 120; y += 4) {
      for (int x = 8; x < 120; x += 4) {
        if (std::hypot(x - 63.5, y - 63.5) < 20.0)
          continue;  // round the top directions change from pixel to pixel
        const Direction found = stroke_direction(picture, x, y);
        double off = std::fmod(std::abs(found.angle - fall_line(x, y)), std::numbers::pi);
        off = std::min(off, std::numbers::pi - off);
        sum += found.certainty * off;
        weights += found.certainty;
      }
    }
    return sum / weights * 180.0 / std::numbers::pi;
  };
  const double with = mean_error_deg(1.0);
  const double without = mean_error_deg(0.0);
  RecordProperty("off_with_deg", std::to_string(with));
  RecordProperty("off_without_deg", std::to_string(without));
  EXPECT_LT(with, 15.0);
  EXPECT_GT(without, 30.0) << "by chance it is 45";
}

// Darkness of valleys is a guide like any other: dark valleys come from dark valleys.
TEST(SynthesizeGuides, DarkValleysComeFromDarkValleys) {
  const auto valleys = [](int width, int height, std::uint64_t seed) {
    Grid<std::uint8_t> depth(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) depth(x, y) = smooth_noise(seed, x, y, 22) < 100 ? 255 : 0;
    return depth;
  };
  Exemplar exemplar;
  exemplar.name = "dark valleys";
  exemplar.picture = Grid<Rgb8>(180, 180);
  exemplar.guides.label = Grid<std::uint8_t>(180, 180, 3);
  exemplar.guides.guides = {{"valley", valleys(180, 180, 1)}};
  for (int y = 0; y < 180; ++y)
    for (int x = 0; x < 180; ++x)
      exemplar.picture(x, y) = grey((exemplar.guides.guides[0].values(x, y) > 0 ? 60 : 150) +
                                    static_cast<int>(random_index(60, 8, x / 4, y)));
  GuideStack target;
  target.label = Grid<std::uint8_t>(128, 128, 3);
  target.guides = {{"valley", valleys(128, 128, 2)}};
  const auto step = [&](double weight) {  // from valleys to slopes, levels of grey
    SynthesisParameters parameters;
    parameters.weights = {{"valley", weight}};
    const Grid<Rgb8> picture = copied(run({exemplar}, target, parameters), {exemplar});
    double sums[2] = {0.0, 0.0};
    int counts[2] = {0, 0};
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const int in_valley = target.guides[0].values[i] > 0 ? 1 : 0;
      sums[in_valley] += picture[i][1];
      ++counts[in_valley];
    }
    return sums[0] / counts[0] - sums[1] / counts[1];
  };
  EXPECT_NEAR(step(1.0), 90.0, 6.0);
  EXPECT_LT(std::abs(step(0.0)), 12.0);
}

}  // namespace
}  // namespace belvedere
