// The texels that synthesis uses, and how often.
#include "texture/synthesis/synthesize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/texture/synthesis/synthetic_land.h"
#include "texture/quality/quality.h"

namespace belvedere {
namespace {

using namespace test;

TEST(Synthesize, ExcludedTexelsAreNeverUsedAndUnusedPixelsGetNone) {
  Exemplar exemplar = painting(140, 120, 1);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 140; ++x)
      if ((x / 9 + y / 7) % 3 == 0) exemplar.guides.label(x, y) = unused_label;
  GuideStack target = land(100, 100, 40);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 100; ++x) target.label(x, y) = unused_label;
  const MatchField field = run({exemplar}, target);
  for (std::size_t i = 0; i < field.size(); ++i) {
    if (target.label[i] == unused_label) {
      ASSERT_EQ(field[i], Match{});
      continue;
    }
    ASSERT_EQ(field[i].exemplar, 0);
    ASSERT_EQ(exemplar.guides.label(field[i].x, field[i].y), target.label[i]);
  }
}

TEST(Synthesize, ClassesWithoutTexelsFallBackOrStayWithout) {
  const std::vector<Exemplar> exemplars{painting(140, 120, 1)};
  GuideStack target = land(80, 80, 40);
  for (int y = 20; y < 40; ++y)
    for (int x = 0; x < 80; ++x) target.label(x, y) = x < 40 ? 100 : 101;
  SynthesisParameters parameters;
  parameters.fallback = {{100, 9}};
  SynthesisNotes notes;
  const MatchField field = synthesize(exemplars, target, parameters, notes);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x) {
      const Match m = field(x, y);
      if (target.label(x, y) == 101) {
        ASSERT_EQ(m, Match{});
      } else {
        ASSERT_EQ(m.exemplar, 0);
        ASSERT_EQ(exemplars[0].guides.label(m.x, m.y),
                  target.label(x, y) == 100 ? 9 : target.label(x, y));
      }
    }
  ASSERT_EQ(notes.notes.size(), 2U);
  EXPECT_NE(notes.notes[0].find("class 100"), std::string::npos);
  EXPECT_NE(notes.notes[1].find("class 101"), std::string::npos);
}

TEST(Synthesize, SeveralExemplarsShareTheWork) {
  const std::vector<Exemplar> one{painting(100, 100, 1)};
  const std::vector<Exemplar> two{one[0], painting(90, 110, 2)};
  const GuideStack target = land(128, 128, 40);
  const MatchField field = run(two, target);
  int second = 0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const Match m = field[i];
    ASSERT_LT(m.exemplar, 2);
    ASSERT_EQ(two[m.exemplar].guides.label(m.x, m.y), target.label[i]);
    second += m.exemplar;
  }
  EXPECT_GT(second, 128 * 128 / 4);
  EXPECT_LT(second, 128 * 128 * 3 / 4);
  EXPECT_LT(mean_guide_error(field, two, target, 0),
            mean_guide_error(run(one, target), one, target, 0));

  // A class that only the second painting has comes entirely from there.
  std::vector<Exemplar> split = two;
  for (std::uint8_t& label : split[0].guides.label) label = label == 7 ? unused_label : label;
  const MatchField from_second = run(split, target);
  for (std::size_t i = 0; i < field.size(); ++i)
    if (target.label[i] == 7) {
      ASSERT_EQ(from_second[i].exemplar, 1);
    }
}

// A target with the exemplar's own guides tempts synthesis to copy the whole of it.
TEST(Synthesize, CapHoldsStrictlyEvenForTheExemplarsOwnGuides) {
  const Exemplar exemplar = painting(128, 128, 1);
  for (const int cap : {16, 64, 240}) {
    SynthesisParameters parameters;
    parameters.copy_cap = cap;
    const std::vector<std::size_t> sizes =
        piece_sizes(run({exemplar}, exemplar.guides, parameters));
    EXPECT_LE(sizes.front(), static_cast<std::size_t>(cap));
    EXPECT_GE(sizes.front(), static_cast<std::size_t>(cap / 2)) << "there are no large pieces";
  }
  // Also where there is almost nothing to choose from.
  Exemplar small = painting(18, 17, 3);
  for (std::uint8_t& label : small.guides.label) label = 3;
  GuideStack target = small.guides;
  SynthesisParameters parameters;
  parameters.copy_cap = 16;
  EXPECT_LE(piece_sizes(run({small}, target, parameters)).front(), 16U);
}

TEST(Synthesize, NoTexelIsUsedTooOften) {
  // Half of the target is higher than all but a few texels.
  const std::vector<Exemplar> exemplars{painting(128, 128, 1)};
  GuideStack target = land(128, 128, 40);
  for (std::uint8_t& label : target.label) label = 9;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x) target.guides[0].values(x, y) = 255;
  const std::size_t texels = static_cast<std::size_t>(
      std::count(exemplars[0].guides.label.begin(), exemplars[0].guides.label.end(), 9));
  const MatchField field = run(exemplars, target);
  const int max = measure_quality(field, exemplars, target, {.repeat_samples = 0}).max_used;
  EXPECT_LE(max, static_cast<int>(6 + 3 * target.label.size() / texels));
  SynthesisParameters free;
  free.reuse = 0;
  EXPECT_GT(measure_quality(run(exemplars, target, free), exemplars, target, {.repeat_samples = 0})
                .max_used,
            2 * max);
}

// With an eighth of a painting, pixels request three altitudes only, and pieces of at most 16
// pixels are moved as a whole until the end: the cap on uses still holds, because pixels take other
// altitudes before they repeat, and a note reports it.
TEST(Synthesize, TheCapOnUsesHoldsWhereAltitudeLeavesFewTexels) {
  std::vector<Exemplar> exemplars{painting(160, 160, 1)};
  exemplars[0].guides.guides.resize(1);
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 160; ++x)
      if (random_index(8, 3, x / 8, y / 8) != 0) exemplars[0].guides.label(x, y) = unused_label;
  GuideStack target = land(160, 160, 40);
  target.guides.resize(1);
  for (std::size_t i = 0; i < target.label.size(); ++i)
    target.guides[0].values[i] = target.label[i] == 3 ? 0 : target.label[i] == 7 ? 100 : 255;
  SynthesisParameters parameters;
  parameters.copy_cap = 16;
  parameters.weights = {{"altitude", 10.0}};
  SynthesisNotes notes;
  const MatchField field = synthesize(exemplars, target, parameters, notes);
  for (const std::uint8_t label : {3, 7, 9}) {
    const auto texels =
        std::count(exemplars[0].guides.label.begin(), exemplars[0].guides.label.end(), label);
    const auto pixels = std::count(target.label.begin(), target.label.end(), label);
    std::map<std::pair<int, int>, int> uses;
    int max = 0;
    for (std::size_t i = 0; i < field.size(); ++i) {
      ASSERT_EQ(exemplars[0].guides.label(field[i].x, field[i].y), target.label[i]);
      if (target.label[i] == label) max = std::max(max, ++uses[{field[i].x, field[i].y}]);
    }
    EXPECT_LE(max, 6 + 3 * pixels / texels) << "class " << int{label};
  }
  ASSERT_EQ(notes.notes.size(), 1U);
  EXPECT_NE(notes.notes[0].find("altitude"), std::string::npos) << notes.notes[0];
  EXPECT_LE(piece_sizes(field).front(), 16U);
  // With enough texels there is no note.
  SynthesisNotes quiet;
  synthesize({painting(160, 160, 1)}, land(120, 120, 40), {}, quiet);
  EXPECT_TRUE(quiet.notes.empty());
}

// The grey of a picture compared with itself shifted by (dx, dy): 1 identical, 0 uncorrelated.
double autocorrelation(const Grid<Rgb8>& picture, int dx, int dy) {
  double a_sum = 0.0, b_sum = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  double n = 0.0;
  for (int y = 0; y + dy < picture.height(); ++y)
    for (int x = std::max(0, -dx); x < picture.width() - std::max(0, dx); ++x) {
      const double a = picture(x, y)[1];
      const double b = picture(x + dx, y + dy)[1];
      a_sum += a;
      b_sum += b;
      aa += a * a;
      bb += b * b;
      ab += a * b;
      n += 1.0;
    }
  return (ab - a_sum * b_sum / n) / std::sqrt((aa - a_sum * a_sum / n) * (bb - b_sum * b_sum / n));
}

// No lattice: nowhere is the picture more similar to itself, shifted, than the painting is. The
// plain repetition of one small painting as tiles is.
TEST(Synthesize, DoesNotRepeatItself) {
  Exemplar exemplar = painting(72, 72, 1);
  for (std::uint8_t& label : exemplar.guides.label) label = 3;
  exemplar.guides.guides.clear();
  for (int y = 0; y < 72; ++y)
    for (int x = 0; x < 72; ++x) {
      const auto bright = static_cast<std::uint8_t>(60 + random_index(120, 8, x / 5, y / 2));
      exemplar.picture(x, y) = {bright, bright, bright};
    }
  GuideStack target;
  target.label = Grid<std::uint8_t>(200, 200, 3);
  const auto strongest = [](const Grid<Rgb8>& picture) {
    double max = 0.0;
    for (int dy = 0; dy <= 96; dy += 2)
      for (int dx = -96; dx <= 96; dx += 1)
        if (dx * dx + dy * dy > 24 * 24) max = std::max(max, autocorrelation(picture, dx, dy));
    return max;
  };
  const MatchField field = run({exemplar}, target);
  const std::vector<const Grid<Rgb8>*> layers{&exemplar.picture};
  const double own = strongest(replay(field, layers, Grid<Rgb8>()));
  MatchField tiles(200, 200);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x)
      tiles(x, y) = {0, static_cast<std::uint16_t>(x % 72), static_cast<std::uint16_t>(y % 72)};
  RecordProperty("autocorrelation", std::to_string(own));
  EXPECT_LT(own, 0.12);
  EXPECT_GT(strongest(replay(tiles, layers, Grid<Rgb8>())), 0.95);
  const double repeat = measure_quality(field, {exemplar}, target, {.guide = ""}).self_repeat;
  RecordProperty("self_repeat", std::to_string(repeat));
  EXPECT_GT(repeat, 0.8);
  EXPECT_LT(measure_quality(tiles, {exemplar}, target, {.guide = ""}).self_repeat, 0.8);
}

TEST(Synthesize, ReuseAndPiecesStayBounded) {
  // One guide that changes slowly: only the prices prevent whole passages from being copied.
  std::vector<Exemplar> exemplars{painting(128, 128, 1)};
  GuideStack target = land(160, 160, 40);
  exemplars[0].guides.guides.resize(1);
  target.guides.resize(1);
  const auto largest = [](const MatchField& field) {
    return static_cast<int>(piece_sizes(field).front());
  };
  SynthesisParameters capped;
  capped.copy_cap = 64;
  const MatchField field = run(exemplars, target, capped);
  EXPECT_LE(max_used(field), 18);
  EXPECT_LE(largest(field), 64);
  EXPECT_GE(largest(field), 32) << "there are no large pieces";
  SynthesisParameters free;
  free.reuse = 0;
  free.copy_cap = 100000;
  const MatchField unbounded = run(exemplars, target, free);
  RecordProperty("largest", largest(field));
  RecordProperty("largest_free", largest(unbounded));
  RecordProperty("used", max_used(field));
  RecordProperty("used_free", max_used(unbounded));
  EXPECT_GT(largest(unbounded), 64 * 3 / 2);
  EXPECT_GT(max_used(unbounded), 24);
}

}  // namespace
}  // namespace belvedere
