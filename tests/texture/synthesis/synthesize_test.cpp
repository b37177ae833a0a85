#include "texture/synthesis/synthesize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "tests/texture/synthesis/synthetic_land.h"
#include "texture/quality/quality.h"
#include "texture/synthesis/synth_kernel.h"

namespace belvedere {
namespace {

using namespace test;

TEST(Synthesize, CopiesFromTheSameClassAlways) {
  const std::vector<Exemplar> exemplars{painting(140, 120, 1)};
  const GuideStack target = land(131, 97, 40);  // odd sides at every level
  SynthesisNotes notes;
  const MatchField field = synthesize(exemplars, target, {}, notes);
  ASSERT_TRUE(field.same_size(target.label));
  for (std::size_t i = 0; i < field.size(); ++i) {
    ASSERT_EQ(field[i].exemplar, 0);
    ASSERT_EQ(exemplars[0].guides.label(field[i].x, field[i].y), target.label[i]);
  }
  EXPECT_EQ(notes.stages.size(), 3U) << "97 / 4 is 24; a further half would be under 16";
  EXPECT_EQ(notes.done, notes.announced);
  EXPECT_TRUE(notes.notes.empty());
}

TEST(Synthesize, SameBitsForAnyThreadsAndVectorWidth) {
  const std::vector<Exemplar> exemplars{painting(140, 120, 1), painting(60, 90, 2)};
  GuideStack target = land(150, 140, 40);
  target.depth_m = Grid<float>(150, 140, 5000.0F);
  for (int y = 60; y < 100; ++y)
    for (int x = 30; x < 90; ++x) target.depth_m(x, y) = 2000.0F;
  MatchField reference;
  {
    const ThreadLimit one(1);
    reference = run(exemplars, target);
  }
  {
    const ThreadLimit two(2);
    EXPECT_EQ(run(exemplars, target), reference);
  }
  for (const std::string& width : synth::vector_targets()) {
    synth::use_vector_target(width);
    EXPECT_EQ(run(exemplars, target), reference) << width;
  }
  synth::use_vector_target("");
  for (const int tile : {2, 64, 256}) {
    SynthesisParameters tiled;
    tiled.tile = tile;
    const ThreadLimit two(2);
    EXPECT_EQ(run(exemplars, target, tiled), reference) << "tiles of " << tile;
  }
  SynthesisParameters other;
  other.seed = 2;
  EXPECT_NE(run(exemplars, target, other), reference);
}

TEST(Synthesize, PatchesOfAnySizeKeepWhatItPromises) {
  const std::vector<Exemplar> exemplars{painting(140, 120, 1), painting(60, 90, 2)};
  GuideStack target = land(131, 97, 40);
  target.depth_m = Grid<float>(131, 97, 5000.0F);
  for (int y = 40; y < 80; ++y)
    for (int x = 30; x < 90; ++x) target.depth_m(x, y) = 2000.0F;
  const MatchField usual = run(exemplars, target);
  MatchField before = usual;
  for (const int side : {3, 5, 9, 11}) {
    SynthesisParameters parameters;
    parameters.neighbourhood = side;
    MatchField reference;
    {
      const ThreadLimit one(1);
      reference = run(exemplars, target, parameters);
    }
    EXPECT_NE(reference, before) << "a size that changes nothing";
    const ThreadLimit two(2);
    for (const std::string& width : synth::vector_targets()) {
      synth::use_vector_target(width);
      EXPECT_EQ(run(exemplars, target, parameters), reference) << side << ' ' << width;
    }
    synth::use_vector_target("");
    const SynthesisQuality quality =
        measure_quality(reference, exemplars, target, {.repeat_samples = 0});
    EXPECT_EQ(quality.label_agreement, 1.0);
    EXPECT_EQ(quality.across_silhouettes, 0.0);
    EXPECT_LE(quality.largest_piece, 240U);
    before = reference;
  }
}

// With guides that identify every texel and no limit on copies, an exemplar's own guides give it
// back.
TEST(Synthesize, OwnGuidesGiveTheExemplarBack) {
  Exemplar exemplar = painting(120, 120, 1);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) {
      exemplar.guides.guides[0].values(x, y) = static_cast<std::uint8_t>(2 * x);
      exemplar.guides.guides[1].values(x, y) = static_cast<std::uint8_t>(2 * y);
    }
  SynthesisParameters parameters;
  parameters.copy_cap = 100000;
  const MatchField field = run({exemplar}, exemplar.guides, parameters);
  int same = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 120; ++x)
      same += field(x, y) == Match{0, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)}
                  ? 1
                  : 0;
  }
  RecordProperty("same_per_mille", same * 1000 / (120 * 120));
  EXPECT_GE(same, 120 * 120 * 95 / 100);
}

TEST(Synthesize, WeightRaisesAgreementOfItsGuide) {
  const std::vector<Exemplar> exemplars{painting(200, 200, 1)};
  const GuideStack target = land(128, 128, 40);
  const auto errors = [&](double altitude, double tone) {
    SynthesisParameters parameters;
    parameters.weights = {{"altitude", altitude}, {"tone", tone}};
    const MatchField field = run(exemplars, target, parameters);
    return std::pair{mean_guide_error(field, exemplars, target, 0),
                     mean_guide_error(field, exemplars, target, 1)};
  };
  const auto [altitude_off, tone_on] = errors(0, 1);
  const auto [altitude_on, tone_off] = errors(1, 0);
  const auto [altitude_both, tone_both] = errors(1, 1);
  EXPECT_LT(altitude_on, 0.3 * altitude_off);
  EXPECT_LT(tone_on, 0.15 * tone_off);
  EXPECT_LT(altitude_both, 0.5 * altitude_off);
  EXPECT_LT(tone_both, 0.25 * tone_off);
}

TEST(Synthesize, GuidesOfOneSideAreNotedOnce) {
  std::vector<Exemplar> exemplars{painting(60, 60, 1), painting(60, 60, 2)};
  GuideStack target = land(40, 40, 40);
  exemplars[0].guides.guides.push_back({"slope", Grid<std::uint8_t>(60, 60)});
  exemplars[1].guides.guides.push_back({"slope", Grid<std::uint8_t>(60, 60)});
  for (Exemplar& exemplar : exemplars)
    exemplar.guides.guides.erase(exemplar.guides.guides.begin() + 1);  // tone
  SynthesisParameters parameters;
  parameters.weights = {{"typo", 2.0}};
  SynthesisNotes notes;
  const MatchField with = synthesize(exemplars, target, parameters, notes);
  ASSERT_EQ(notes.notes.size(), 3U);
  EXPECT_NE(notes.notes[0].find("\"tone\""), std::string::npos);
  EXPECT_NE(notes.notes[1].find("\"slope\""), std::string::npos);
  EXPECT_NE(notes.notes[2].find("\"typo\""), std::string::npos);
  exemplars[0].guides.guides.resize(1);
  exemplars[1].guides.guides.resize(1);
  target.guides.resize(1);
  EXPECT_EQ(run(exemplars, target), with);
}

TEST(Synthesize, NoPieceRunsOnAcrossADepthJump) {
  const std::vector<Exemplar> exemplars{painting(160, 160, 1)};
  GuideStack target = land(120, 120, 40);
  const MatchField without = run(exemplars, target);
  // A near hill in front of a far plain in front of the sky, and a thin near spire.
  target.depth_m = Grid<float>(120, 120, 5000.0F);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) {
      if (y < 20) target.depth_m(x, y) = std::numeric_limits<float>::infinity();
      if ((x - 50) * (x - 50) + (y - 90) * (y - 90) < 1600) target.depth_m(x, y) = 2000.0F;
      if (x == 100 && y > 10) target.depth_m(x, y) = 900.0F;
    }
  const QualityParameters quick{.repeat_samples = 0};
  EXPECT_GT(measure_quality(without, exemplars, target, quick).across_silhouettes, 0.5);
  for (const std::uint64_t seed : {1U, 2U}) {
    SynthesisParameters parameters;
    parameters.seed = seed;
    const MatchField field = run(exemplars, target, parameters);
    EXPECT_EQ(measure_quality(field, exemplars, target, quick).across_silhouettes, 0.0);
    EXPECT_EQ(measure_quality(field, exemplars, target, quick).label_agreement, 1.0);
  }
}

// Neighbours that copy with one offset texels on both sides of a jump of the exemplar's depth.
int pairs_across(const MatchField& field, const Grid<float>& depth_m) {
  int count = 0;
  for (int y = 0; y < field.height(); ++y)
    for (int x = 0; x < field.width(); ++x)
      for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}}) {
        if (!field.contains(x + dx, y + dy)) continue;
        const Match a = field(x, y), b = field(x + dx, y + dy);
        if (a.exemplar != b.exemplar || b.x - a.x != dx || b.y - a.y != dy) continue;
        const float near = std::min(depth_m(a.x, a.y), depth_m(b.x, b.y));
        const float far = std::max(depth_m(a.x, a.y), depth_m(b.x, b.y));
        count += far > 1.04F * near ? 1 : 0;
      }
  return count;
}

TEST(Synthesize, NoPieceIsCopiedAcrossADepthJumpOfTheExemplar) {
  std::vector<Exemplar> exemplars{painting(160, 160, 1)};
  GuideStack target = land(120, 120, 40);
  // A ridge before a far plain, and a spire.
  Grid<float> depth_m(160, 160, 5000.0F);
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 160; ++x) {
      if (y > 60 + 20 * std::sin(0.1 * x)) depth_m(x, y) = 2000.0F;
      if (x == 100) depth_m(x, y) = 900.0F;
    }
  EXPECT_GT(pairs_across(run(exemplars, target), depth_m), 40);
  exemplars[0].guides.depth_m = depth_m;
  for (const bool silhouettes_in_target : {false, true}) {
    if (silhouettes_in_target) {
      target.depth_m = Grid<float>(120, 120, 5000.0F);
      for (int y = 50; y < 120; ++y)
        for (int x = 0; x < 120; ++x) target.depth_m(x, y) = 2000.0F;
    }
    for (const int cap : {240, 40}) {
      SynthesisParameters parameters;
      parameters.copy_cap = cap;
      const MatchField field = run(exemplars, target, parameters);
      EXPECT_EQ(pairs_across(field, depth_m), 0);
      EXPECT_GT(measure_quality(field, exemplars, target, {.repeat_samples = 0}).coherence, 0.5);
    }
  }
}

TEST(Synthesize, SurroundingsDecideWhatBordersOnWhat) {
  // Class 3 borders on 7 in the left half and on 9 in the right half of the painting; in the target
  // on 7 only.
  Exemplar exemplar = painting(160, 80, 1);
  exemplar.guides.guides.clear();
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 160; ++x)
      exemplar.guides.label(x, y) = y / 12 % 2 == 0 ? 3 : x < 80 ? 7 : 9;
  GuideStack target;
  target.label = Grid<std::uint8_t>(80, 80);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x) target.label(x, y) = x / 12 % 2 == 0 ? 3 : 7;
  const auto from_the_left = [&](double weight, double class_dissimilarity) {
    SynthesisParameters parameters;
    parameters.surroundings = weight;
    parameters.class_dissimilarity = {{{9, 7}, class_dissimilarity}};
    const MatchField field = run({exemplar}, target, parameters);
    int left = 0;
    int all = 0;
    for (int y = 0; y < 80; ++y) {
      for (int x = 0; x < 80; ++x) {
        if (target.label(x, y) != 3 || x % 12 < 3 || x % 12 >= 9)
          continue;  // patches show the border by themselves
        ++all;
        left += field(x, y).x < 80 ? 1 : 0;
      }
    }
    return static_cast<double>(left) / all;
  };
  EXPECT_LT(from_the_left(0, 1), 0.88);
  EXPECT_GT(from_the_left(100, 1), 0.95);
  EXPECT_LT(from_the_left(100, 0), 0.9) << "7 and 9 have dissimilarity 0";
}

// Bands of 3 between bands of 7, which in the left half of the painting contain specks of 9: fewer
// than 7, so the most common other class is 7 everywhere, and does not show them.
TEST(Synthesize, AllSurroundingsTellAThirdClass) {
  Exemplar exemplar = painting(160, 96, 1);
  exemplar.guides.guides.clear();
  const auto label_at = [](int x, int y, bool third) -> std::uint8_t {
    return y % 24 < 12 ? 3 : third && x % 5 < 2 ? 9 : 7;
  };
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 160; ++x) exemplar.guides.label(x, y) = label_at(x, y, x < 80);
  GuideStack target;
  target.label = Grid<std::uint8_t>(80, 96);
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 80; ++x) target.label(x, y) = label_at(x, y, true);
  const auto from_the_left = [&](const std::string& which, double class_dissimilarity) {
    SynthesisParameters parameters;
    parameters.levels = 1;     // patches of coarser ones reach the other classes anyway,
    parameters.copy_cap = 16;  // and large pieces are determined by their ends
    parameters.surroundings = 100;
    parameters.surroundings_of = which;
    parameters.class_dissimilarity = {{{7, 9}, class_dissimilarity}};
    const MatchField field = run({exemplar}, target, parameters);
    int left = 0;
    int all = 0;
    for (int y = 0; y < 96; ++y) {
      for (int x = 0; x < 80; ++x) {
        if (y % 24 < 4 || y % 24 > 7) continue;  // so do patches next to the border
        ++all;
        left += field(x, y).x < 80 ? 1 : 0;
      }
    }
    return static_cast<double>(left) / all;
  };
  const double all = from_the_left("all", 1);
  const double commonest = from_the_left("commonest", 1);
  const double alike = from_the_left("all", 0);
  RecordProperty("left_all", std::to_string(all));
  RecordProperty("left_commonest", std::to_string(commonest));
  RecordProperty("left_alike", std::to_string(alike));
  EXPECT_GT(all, 0.88);
  EXPECT_LT(commonest, 0.8);
  EXPECT_LT(alike, all - 0.04) << "7 and 9 have dissimilarity 0";
}

// Weak guides that no texel can meet together must not reduce the effect of the strongest one.
TEST(Synthesize, ManyWeakGuidesLeaveTheStrongOneAlone) {
  std::vector<Exemplar> exemplars{painting(128, 128, 1)};
  GuideStack target = land(128, 128, 40);
  exemplars[0].guides.guides.resize(1);
  target.guides.resize(1);
  const double alone = mean_guide_error(run(exemplars, target), exemplars, target, 0);
  SynthesisParameters parameters;
  for (int g = 0; g < 5; ++g) {
    const auto noise = [&](std::uint64_t seed) {
      Grid<std::uint8_t> values(128, 128);
      for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x)
          values(x, y) = smooth_noise(seed + static_cast<std::uint64_t>(g), x, y, 20);
      return values;
    };
    const std::string name = "noise " + std::to_string(g);
    exemplars[0].guides.guides.push_back({name, noise(100)});
    target.guides.push_back({name, noise(200)});
    parameters.weights.emplace_back(name, 0.12);  // under an eighth: none of them orders the lists
  }
  const double among_many =
      mean_guide_error(run(exemplars, target, parameters), exemplars, target, 0);
  RecordProperty("many_alone_milli", static_cast<int>(1000 * alone));
  RecordProperty("many_among_milli", static_cast<int>(1000 * among_many));
  // Measured: 1.41 times the error; 1.60 times if the usual errors of picks are priced as well.
  EXPECT_LT(among_many, 1.5 * alone);
}

TEST(Synthesize, ReplaysOntoAnotherLayer) {
  const std::vector<Exemplar> exemplars{painting(80, 80, 1)};
  const MatchField field = run(exemplars, land(64, 64, 40));
  Grid<int> layer(80, 80);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x) layer(x, y) = 1000 * y + x;
  const Grid<int> out = replay<int>(field, {&layer}, Grid<int>());
  for (std::size_t i = 0; i < out.size(); ++i) ASSERT_EQ(out[i], 1000 * field[i].y + field[i].x);
}

TEST(Synthesize, SmallestCasesWork) {
  Exemplar dot;
  dot.name = "dot";
  dot.picture = Grid<Rgb8>(1, 1);
  dot.guides.label = Grid<std::uint8_t>(1, 1, 5);
  GuideStack target;
  target.label = Grid<std::uint8_t>(3, 2, 5);
  EXPECT_EQ(run({dot}, target), MatchField(3, 2, Match{0, 0, 0}));
  target.label = Grid<std::uint8_t>(1, 1, unused_label);
  EXPECT_EQ(run({dot}, target), MatchField(1, 1));
  dot.guides.label(0, 0) = unused_label;
  target.label(0, 0) = 5;
  EXPECT_EQ(run({dot}, target), MatchField(1, 1));
}

TEST(Synthesize, RefusesWhatItCannotUse) {
  const std::vector<Exemplar> good{painting(40, 40, 1)};
  const GuideStack target = land(40, 40, 2);
  const auto kind = [&](const std::vector<Exemplar>& exemplars, const GuideStack& stack,
                        const SynthesisParameters& parameters) {
    try {
      run(exemplars, stack, parameters);
    } catch (const Error& error) {
      return error.exit_status();
    }
    return 0;
  };
  EXPECT_EQ(kind({}, target, {}), 2);
  EXPECT_EQ(kind(good, GuideStack{}, {}), 2);
  std::vector<Exemplar> bad = good;
  bad[0].picture = Grid<Rgb8>(41, 40);
  EXPECT_EQ(kind(bad, target, {}), 2);
  bad = good;
  bad[0].guides.guides[0].values = Grid<std::uint8_t>(40, 41);
  EXPECT_EQ(kind(bad, target, {}), 2);
  bad = good;
  bad[0].guides.guides[1].name = "altitude";
  EXPECT_EQ(kind(bad, target, {}), 2);
  GuideStack shallow = target;
  shallow.depth_m = Grid<float>(3, 3);
  EXPECT_EQ(kind(good, shallow, {}), 2);
  bad = good;
  bad[0].picture = Grid<Rgb8>(32768, 1);
  bad[0].guides = GuideStack{Grid<std::uint8_t>(32768, 1), {}, {}};
  EXPECT_EQ(kind(bad, target, {}), 5);
  SynthesisParameters parameters;
  parameters.levels = 9;
  EXPECT_EQ(kind(good, target, parameters), 2);
  parameters = {};
  parameters.weights = {{"tone", -1.0}};
  EXPECT_EQ(kind(good, target, parameters), 2);
  parameters.weights = {{"tone", std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_EQ(kind(good, target, parameters), 2);
  parameters = {};
  parameters.copy_cap = 15;
  EXPECT_EQ(kind(good, target, parameters), 2);
  parameters = {};
  parameters.neighbourhood = 6;
  EXPECT_EQ(kind(good, target, parameters), 2);
  parameters.neighbourhood = 13;
  EXPECT_EQ(kind(good, target, parameters), 2);
  parameters = {};
  parameters.distance = "cosine";
  EXPECT_EQ(kind(good, target, parameters), 2);
  parameters = {};
  parameters.surroundings_of = "some";
  EXPECT_EQ(kind(good, target, parameters), 2);
  parameters = {};
  parameters.tile = 63;
  EXPECT_EQ(kind(good, target, parameters), 2);
  parameters = {};
  parameters.surroundings = -1;
  EXPECT_EQ(kind(good, target, parameters), 2);
  parameters = {};
  parameters.class_dissimilarity = {{{3, 7}, 1.5}};
  EXPECT_EQ(kind(good, target, parameters), 2);
  EXPECT_EQ(kind(good, target, {}), 0);
}

}  // namespace
}  // namespace belvedere
