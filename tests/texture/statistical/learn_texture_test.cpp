#include "texture/statistical/learn_texture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>
#include <vector>

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

// The Euclidean distance of a type's histograms in two pictures, from single pixels: 32 even groups
// between the first one's .5 % and 99.5 %, and two outside.
double plain_distance(const BandPicture& example, const BandPicture& made, const BandSpace& bands,
                      const CliqueType& type) {
  const DifferenceRange range = difference_range(bands, type);
  const auto bins_of = [&](const BandPicture& picture) {
    std::vector<int> bins;
    for (int y = 0; y + type.dy < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x) {
        const int hx = x + type.dx;
        if (hx < 0 || hx >= picture.width()) continue;
        const float head = picture.band(type.head)(hx, y + type.dy);
        const float value = type.single() ? head : head - picture.band(type.tail)(x, y);
        bins.push_back(std::clamp(
            static_cast<int>((value - range.low) * (1024.F / (range.high - range.low))), 0, 1023));
      }
    std::sort(bins.begin(), bins.end());
    return bins;
  };
  const std::vector<int> wanted = bins_of(example);
  const std::vector<int> found = bins_of(made);
  // The bins of the first and last pixels that are not in the tails.
  const std::size_t tail = wanted.size() / 200;
  const int from = wanted[tail] > 0 ? wanted[tail] - 1 : 0;
  const int to = std::max(wanted[wanted.size() - tail - 1], from + 4);
  std::array<double, 34> off{};
  const auto count = [&](const std::vector<int>& bins, double sign) {
    for (const int bin : bins) {
      const int group = bin < from ? 0 : bin >= to ? 33 : 1 + (bin - from) * 32 / (to - from);
      off[static_cast<std::size_t>(group)] += sign / static_cast<double>(bins.size());
    }
  };
  count(found, 1.0);
  count(wanted, -1.0);
  double sum = 0.0;
  for (const double o : off) sum += o * o;
  return std::sqrt(sum);
}

// Steps 4 and 5 of the paper by brute force: all pairs up to the reach, counted pixel by pixel in
// the texture made so far. What learning adds is the farthest.
TEST(LearnTexture, AddsTheFarthestOfAllPairsByBruteForce) {
  constexpr int reach = 4;
  constexpr std::size_t first = 12;  // always in
  LearnParameters parameters;
  parameters.levels = 0;
  parameters.types = first + 3;
  parameters.reach_px = reach;
  parameters.enough = 0.0;
  const Grid<Rgb8> crop = test::striped_crop(64, 56, 10);
  const CliqueModel learned = learn_texture(crop, {}, parameters).model;
  ASSERT_EQ(learned.cliques.size(), first + 3);
  const BandPicture example = to_bands(crop, learned.bands, {});
  CliqueModel now = learned;
  now.cliques.resize(first);
  TextureTrial trial(now, crop.width(), crop.height(), 5);
  trial.begin_level(now, 0);
  for (std::size_t added = first; added < learned.cliques.size(); ++added) {
    trial.run(now, 0, added == first ? 2 * parameters.rounds : parameters.rounds);
    const auto distance = [&](const CliqueType& type) {
      return plain_distance(example, trial.picture(0), now.bands, type);
    };
    double farthest = 0.0;
    int candidates = 0;
    for (int dy = 0; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        if (dx * dx + dy * dy > reach * reach || (dy == 0 && dx < 0)) continue;
        for (int head = 0; head < 3; ++head)
          for (int tail = 0; tail < 3; ++tail) {
            const CliqueType type{0, dx, dy, head, tail};
            if ((dx == 0 && dy == 0 && head > tail) ||
                std::any_of(now.cliques.begin(), now.cliques.end(),
                            [&](const Clique& c) { return c.type == type; }))
              continue;
            farthest = std::max(farthest, distance(type));
            ++candidates;
          }
      }
    EXPECT_EQ(candidates, 6 + 9 * 24 - static_cast<int>(added));
    EXPECT_NEAR(distance(learned.cliques[added].type), farthest, 1e-4) << added;
    EXPECT_GT(farthest, .02);
    now.cliques.push_back(learned.cliques[added]);
  }
}

// What is left of the farthest pair falls with the number of types.
TEST(LearnTexture, MoreTypesLeaveLess) {
  Grid<Rgb8> crop = test::meadow_crop(80, 64);
  const Grid<Rgb8> stripes = test::striped_crop(80, 64, 12);
  for (std::size_t i = 0; i < crop.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      crop[i][c] = test::level(crop[i][c] + .3 * (stripes[i][c] - 130));
  const auto residual = [&](int types) {
    const LearnedTexture learned =
        learn_texture(crop, {}, {.types = types, .levels = 2, .rounds = 8});
    EXPECT_LE(learned.model.cliques.size(), static_cast<std::size_t>(types) + 1);
    return learned.levels.back().worst_l2;
  };
  const double at_16 = residual(16);
  const double at_28 = residual(28);
  const double at_40 = residual(40);
  EXPECT_GT(at_16, at_28);
  EXPECT_GT(at_28, at_40);
  EXPECT_LT(at_40, .5 * at_16);
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
