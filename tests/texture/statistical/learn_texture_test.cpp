#include "texture/statistical/learn_texture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "base/error.h"
#include "tests/files.h"
#include "tests/texture/statistical/texture_crops.h"
#include "texture/statistical/clique_model.h"
#include "texture/statistical/make_texture.h"
#include "texture/statistical/texture_figures.h"

namespace belvedere {
namespace {

using ::testing::HasSubstr;

// Half of the discs of radius r, nine pairs of bands each, and the six at one pixel.
TEST(CandidateTypes, AreAHalfPlaneOfAllPairs) {
  const std::vector<CliqueType> types = candidate_types(1, 5);
  std::set<std::pair<int, int>> offsets;
  for (const CliqueType& t : types) {
    EXPECT_EQ(t.level, 1);
    EXPECT_TRUE(t.dy > 0 || (t.dy == 0 && t.dx >= 0));
    EXPECT_LE(t.dx * t.dx + t.dy * t.dy, 25);
    offsets.insert({t.dx, t.dy});
    EXPECT_FALSE(t.dx + t.dy != 0 && offsets.contains({-t.dx, -t.dy})) << "both ways";
  }
  EXPECT_EQ(types.size(), 6U + 9U * (offsets.size() - 1));
  EXPECT_EQ(types.size(), 366U);
  EXPECT_EQ(candidate_types(0, 8).size(), 888U);
}

TEST(LearnTexture, HoldsWhatIsAlwaysInWithinItsBudget) {
  LearnParameters parameters;
  parameters.types = 26;
  const LearnedTexture learned = learn_texture(test::meadow_crop(96, 80), {}, parameters);
  const auto has = [&](CliqueType t) {
    return std::any_of(learned.model.cliques.begin(), learned.model.cliques.end(),
                       [&](const Clique& c) { return c.type == t; });
  };
  for (int band = 0; band < 3; ++band) {
    EXPECT_TRUE(has({0, 0, 0, band, band}));
    EXPECT_TRUE(has({0, 1, 0, band, band}));
    EXPECT_TRUE(has({0, 0, 1, band, band}));
  }
  EXPECT_TRUE(has({0, 0, 0, 0, 2}));
  EXPECT_LE(learned.model.cliques.size(), 26U);
  EXPECT_EQ(learned.levels.size(), 4U);
  EXPECT_EQ(learned.levels.front().level, 3);
  EXPECT_LT(model_bytes(learned.model), 1000U);
  EXPECT_EQ(learned.model.crop_hash.size(), 32U);
}

// Stripes of period 8: the first pair found beyond the neighbours is along the row, not down the
// column.
TEST(LearnTexture, FindsThePairThatTellsMost) {
  LearnParameters parameters;
  parameters.levels = 0;
  parameters.types = 16;
  const CliqueModel model = learn_texture(test::striped_crop(96, 64, 8), {}, parameters).model;
  ASSERT_EQ(model.cliques.size(), 16U);
  const CliqueType found = model.cliques.back().type;
  EXPECT_GT(std::abs(found.dx), 1);  // down a column nothing changes but the grain
}

// The farthest type left out comes closer with each type that is added; learning stops where it is
// close enough, or where the budget is used up.
TEST(LearnTexture, ComesCloserAndStopsAtTheThreshold) {
  const Grid<Rgb8> crop = test::striped_crop(64, 64, 8);
  const auto learn = [&](int types, double enough) {
    LearnParameters parameters;
    parameters.levels = 0;
    parameters.types = types;
    parameters.reach_px = 5;
    parameters.enough = enough;
    const LearnedTexture learned = learn_texture(crop, {}, parameters);
    EXPECT_EQ(learned.levels.size(), 1U);
    return std::pair(learned.model.cliques.size(), learned.levels.back().worst_l2);
  };
  const auto [none, first] = learn(40, 10.0);
  EXPECT_EQ(none, 12U) << "three plain histograms, three pairs of bands, six neighbours";
  const auto [some, closer] = learn(16, 0.0);
  EXPECT_EQ(some, 16U);
  EXPECT_LT(closer, 0.9 * first);
  const double between = 0.5 * (first + closer);
  const auto [enough, at_end] = learn(40, between);
  EXPECT_GT(enough, 12U);
  EXPECT_LE(enough, 16U);
  EXPECT_LT(at_end, between);
}

// Two colours never mix where a mask excludes one of them.
TEST(LearnTexture, KnowsNothingOfWhatIsMasked) {
  Grid<Rgb8> crop = test::meadow_crop(128, 96);
  Grid<std::uint8_t> states(128, 96, pixel_free);
  for (int y = 0; y < 96; ++y)
    for (int x = 64; x < 128; ++x) {
      crop(x, y) = {255, 40, 40};
      states(x, y) = 0;
    }
  const CliqueModel masked = learn_texture(crop, states, {.types = 16, .levels = 1}).model;
  const CliqueModel whole = learn_texture(crop, {}, {.types = 16, .levels = 1}).model;
  EXPECT_LT(masked.bands.mean[0], 110.F);
  EXPECT_GT(whole.bands.mean[0], 150.F);
  // The widest axis of the meadow is that of its light and shade, green with red; with the red half
  // it is that from green to red.
  EXPECT_GT(masked.bands.axis(0, 0) * masked.bands.axis(0, 1), .1F);
  EXPECT_LT(whole.bands.axis(0, 0) * whole.bands.axis(0, 1), 0.F);
}

TEST(LearnTexture, RefusesWhatIsNoTexture) {
  const auto words = [](const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states) -> std::string {
    try {
      learn_texture(crop, states, {});
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::input);
      return e.what();
    }
    return {};
  };
  EXPECT_THAT(words(test::meadow_crop(47, 200), {}), HasSubstr("47 × 200"));
  EXPECT_THAT(words(Grid<Rgb8>(64, 64, Rgb8{1, 2, 3}), {}), HasSubstr("single colour"));
  EXPECT_THAT(words(test::meadow_crop(64, 64), Grid<std::uint8_t>(64, 60, pixel_free)),
              HasSubstr("64 × 60"));
  EXPECT_THAT(words(test::meadow_crop(64, 64), Grid<std::uint8_t>(64, 64, 0)),
              HasSubstr("0 pixels that are opaque and in its mask"));
}

TEST(LearnTexture, CropsOverTheLimitAreRefused) {
  const Error large = test::error_of(
      [] { learn_texture(Grid<Rgb8>(static_cast<int>(max_texture_pixels / 48) + 1, 48), {}, {}); });
  EXPECT_EQ(large.kind(), ErrorKind::limit);
  EXPECT_THAT(large.what(), HasSubstr("64 Mpixels"));
}

const LearnParameters few{.types = 18};

const CliqueModel& sampled() {
  static const CliqueModel model = learn_by_sampling(test::meadow_crop(64, 64), {}, few).model;
  return model;
}

TEST(LearnBySampling, PreselectsNeighboursAndAddsUpToItsBudget) {
  const CliqueModel& model = sampled();
  EXPECT_EQ(model.levels, 0);
  EXPECT_TRUE(model.sampled);
  EXPECT_EQ(model.cliques.size(), 18U);
  for (int band = 0; band < 3; ++band)
    for (const CliqueType& type : {CliqueType{0, 0, 0, band, band}, CliqueType{0, 1, 0, band, band},
                                   CliqueType{0, 0, 1, band, band}})
      EXPECT_TRUE(std::any_of(model.cliques.begin(), model.cliques.end(),
                              [&](const Clique& c) { return c.type == type; }));
  EXPECT_EQ(model_text(parse_model(model_text(model), "x.model")), model_text(model));
}

// The reference: from noise, the sampler reaches the crop's statistics, and flow with polish comes
// as close, also in types that neither uses.
TEST(LearnBySampling, FlowAndPolishComeAsNearAsTheSampler) {
  const Grid<Rgb8> crop = test::meadow_crop(64, 64);
  const LearnParameters level{.types = 18, .levels = 0};
  const Grid<Rgb8> by_sampler = make_texture(sampled(), 96, 96, {});
  const TextureFigures sampler = texture_figures(crop, {}, by_sampler, sampled(), level);
  const TextureFigures ours = texture_figures(
      crop, {}, make_texture(learn_texture(crop, {}, {.types = 28}).model, 96, 96, {}), sampled(),
      level);
  RecordProperty("sampler", std::to_string(sampler.held_out));
  RecordProperty("flow", std::to_string(ours.held_out));
  EXPECT_LT(sampler.selected, .35);
  EXPECT_LT(ours.held_out, 1.1 * sampler.held_out) << sampler.held_out;
  EXPECT_EQ(make_texture(sampled(), 20, 20, {.sweeps = 2}),
            make_texture(sampled(), 20, 20, {.sweeps = 2}));
}

TEST(LearnBySampling, LargeCropsAndWindowsAreRefused) {
  EXPECT_THROW(learn_by_sampling(test::meadow_crop(257, 64), {}, few), Error);
  EXPECT_THROW(learn_by_sampling(test::meadow_crop(47, 64), {}, few), Error);
  EXPECT_THROW(make_window(sampled(), {}, {0, 0, 10, 10}, {}), Error);
}

TEST(LearningRound, TheCropItselfIsNoDistanceAwayAndStrangersAre) {
  const Grid<Rgb8> crop = test::striped_crop(64, 64, 8);
  const BandSpace bands = find_bands(crop, {});
  const BandPicture example = to_bands(crop, bands, {});
  std::vector<CliqueCandidate> candidates = make_candidates(example, bands, candidate_types(0, 4));
  const LearningRound same = evaluate_candidates(candidates, example, bands);
  EXPECT_EQ(same.worst, candidates.size());
  EXPECT_EQ(same.told.types, 0);
  EXPECT_EQ(same.told.held_out_l1, 0.0);

  const BandPicture turned = to_bands(test::meadow_crop(64, 64), bands, {});
  const LearningRound other = evaluate_candidates(candidates, turned, bands);
  ASSERT_LT(other.worst, candidates.size());
  EXPECT_GT(other.told.worst_l2, .1);
  // Included types are not tested again.
  candidates[other.worst].in = true;
  const LearningRound next = evaluate_candidates(candidates, turned, bands);
  EXPECT_NE(next.worst, other.worst);
  EXPECT_EQ(next.told.types, 1);
  EXPECT_LE(next.told.worst_l2, other.told.worst_l2);
}

}  // namespace

}  // namespace belvedere
