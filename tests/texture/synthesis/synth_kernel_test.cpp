#include "texture/synthesis/synth_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "base/random.h"
#include "texture/synthesis/synth_bins.h"
#include "texture/synthesis/synth_level.h"
#include "texture/synthesis/synth_replace.h"

namespace belvedere::synth {
namespace {

constexpr int classes = 3;

// A plane of noise with blotches of classes and smooth guides; `seed` tells pictures apart.
Plane noise_plane(std::vector<std::pair<int, int>> sizes, int guides, std::uint64_t seed, bool with_holes) {
  Plane plane = make_plane(sizes, guides);
  for (std::size_t p = 0; p < plane.parts.size(); ++p) {
    for (int y = 0; y < plane.parts[p].height; ++y) {
      for (int x = 0; x < plane.parts[p].width; ++x) {
        const std::uint32_t at = plane.index(static_cast<int>(p), x, y);
        std::uint32_t c = random_index(classes, seed, x / 5, y / 4, p);
        if (with_holes && random_index(20, seed + 1, x / 2, y / 2, p) == 0) c = no_class;
        plane.words[at] = static_cast<std::uint32_t>(random_bits(seed + 2, x, y, p) & 0xffffffU) | c << 24;
        for (int g = 0; g < guides; ++g) {
          plane.guides[at * static_cast<std::size_t>(guides) + static_cast<std::size_t>(g)] =
              static_cast<std::uint8_t>(random_index(256, seed + 3, x / 3, y / 3, static_cast<std::uint64_t>(g)));
        }
      }
    }
  }
  pad(plane);
  return plane;
}

// The price of a patch, as the formula says it and no faster.
std::int64_t naive_patch_cost(const Plane& target, std::uint32_t pixel, const Plane& exemplars, std::uint32_t texel,
                              const std::array<std::array<bool, 7>, 7>& counts) {
  std::int64_t sum = 0;
  std::int64_t mismatches = 0;
  for (int dy = -3; dy <= 3; ++dy) {
    for (int dx = -3; dx <= 3; ++dx) {
      const std::uint32_t a = target.words[static_cast<std::size_t>(static_cast<std::int64_t>(pixel) + dy * target.stride + dx)];
      const std::uint32_t b = exemplars.words[static_cast<std::size_t>(static_cast<std::int64_t>(texel) + dy * exemplars.stride + dx)];
      if (class_of(a) == no_class || !counts[static_cast<std::size_t>(dy + 3)][static_cast<std::size_t>(dx + 3)]) continue;
      const std::int64_t weight = std::lround(16.0 * std::exp(-(dx * dx + dy * dy) / 8.0));
      for (int c = 0; c < 3; ++c) {
        const int d = static_cast<int>(a >> (8 * c) & 255U) - static_cast<int>(b >> (8 * c) & 255U);
        sum += weight * d * d;
      }
      if (class_of(a) != class_of(b)) ++mismatches;
    }
  }
  return (sum >> 3) + 3000 * mismatches;
}

std::array<std::array<bool, 7>, 7> whole_patch() {
  std::array<std::array<bool, 7>, 7> all{};
  for (auto& row : all) row.fill(true);
  return all;
}

class EachVectorWidth : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { use_vector_target(GetParam()); }
  void TearDown() override { use_vector_target(""); }
};

TEST_P(EachVectorWidth, PatchCostEqualsTheFormula) {
  const Plane exemplars = noise_plane({{23, 17}, {9, 31}}, 1, 5, true);
  Plane target = noise_plane({{19, 21}}, 1, 50, true);
  LevelState state(settings_for_level(2, 1, 240, 1.0), {GuideRole{2880}}, classes, exemplars, target, {});
  start_from_picks(state);
  const KernelView view = state.view(0);
  int compared = 0;
  target.for_each([&](std::uint32_t pixel) {
    if (class_of(target.words[pixel]) == no_class) return;
    const int part = static_cast<int>(random_index(2, 7, pixel, 0));
    const Plane::Part& p = exemplars.parts[static_cast<std::size_t>(part)];
    const std::uint32_t texel = exemplars.index(part, static_cast<int>(random_index(static_cast<std::uint32_t>(p.width), 8, pixel, 0)),
                                                static_cast<int>(random_index(static_cast<std::uint32_t>(p.height), 9, pixel, 0)));
    ASSERT_EQ(patch_cost(view, pixel, texel), naive_patch_cost(target, pixel, exemplars, texel, whole_patch()));
    ++compared;
  });
  EXPECT_GT(compared, 300);
}

TEST_P(EachVectorWidth, BlackAgainstWhiteDoesNotOverflow) {
  Plane exemplars = make_plane({{7, 7}}, 0);
  exemplars.for_each([&](std::uint32_t at) { exemplars.words[at] = 0x00ffffffU; });
  pad(exemplars);
  Plane target = make_plane({{7, 7}}, 0);
  target.for_each([&](std::uint32_t at) { target.words[at] = 0xfe000000U; });
  pad(target);
  KernelView view;
  view.target = &target;
  view.exemplars = &exemplars;
  std::int64_t weights = 0;
  for (int dy = -3; dy <= 3; ++dy) {
    for (int dx = -3; dx <= 3; ++dx) weights += std::lround(16.0 * std::exp(-(dx * dx + dy * dy) / 8.0));
  }
  EXPECT_EQ(patch_cost(view, target.index(0, 3, 3), exemplars.index(0, 3, 3)), (weights * 3 * 255 * 255 >> 3) + 49 * 3000);
}

// The formula of the guides' price, and which way it is computed. `weights` in sixteenths.
void expect_guide_prices(const std::vector<std::int64_t>& weights, bool at_once) {
  const int count = static_cast<int>(weights.size());
  Plane exemplars = noise_plane({{23, 17}, {9, 31}}, count, 5, false);
  Plane target = noise_plane({{19, 21}}, count, 50, false);
  // The dearest texel there is: every guide off by 255.
  const std::uint32_t white = exemplars.index(1, 4, 20);
  const std::uint32_t black = target.index(0, 9, 9);
  for (int g = 0; g < count; ++g) {
    exemplars.guides[white * static_cast<std::size_t>(count) + static_cast<std::size_t>(g)] = 255;
    target.guides[black * static_cast<std::size_t>(count) + static_cast<std::size_t>(g)] = 0;
  }
  std::vector<GuideRole> roles;
  for (const std::int64_t weight : weights) roles.push_back({weight});
  LevelState state(settings_for_level(1, 1, 240, 1.0), roles, classes, exemplars, target, {});
  EXPECT_EQ(!state.source->vector_weights.empty(), at_once);
  const auto expect = [&](bool with_slack) {
    KernelView view = state.view(0);
    if (!with_slack) view.usual_error = nullptr;
    std::int64_t dearest = 0;
    target.for_each([&](std::uint32_t pixel) {
      const Slack slack = make_slack(view, pixel);
      exemplars.for_each([&](std::uint32_t texel) {
        if (texel % 7 != pixel % 7 && texel != white) return;
        std::int64_t sum = 0;
        for (int g = 0; g < count; ++g) {
          const std::int64_t free = g == 0 ? slack.sorted : g == 1 ? slack.bucketed : with_slack ? slack.others[g] : 0;
          const std::int64_t off = std::max<std::int64_t>(0, std::abs(target.guides_at(pixel)[g] - exemplars.guides_at(texel)[g]) - free);
          sum += weights[static_cast<std::size_t>(g)] * off * off;
        }
        ASSERT_EQ(guides_cost(view, pixel, texel), sum >> 4) << count << " guides, pixel " << pixel << ", texel " << texel;
        ASSERT_EQ(guide_cost(view, target.guides_at(pixel), exemplars.guides_at(texel), slack), sum >> 4);
        dearest = std::max(dearest, sum);
      });
    });
    EXPECT_GT(dearest, 0);
    return dearest;
  };
  expect(true);
  const std::int64_t dearest = expect(false);
  if (!at_once && count > 2 && count <= vector_guides) {
    EXPECT_GT(dearest, std::int64_t{UINT32_MAX}) << "32 bits would have done";
  }
}

TEST_P(EachVectorWidth, GuidesArePricedByTheFormula) {
  expect_guide_prices({2880, 200, 700}, true);
  expect_guide_prices({2880, 1000, 300, 300, 300, 200, 200}, true);
  expect_guide_prices({2880, 1000, 300, 31, 300, 17, 200, 1}, true);
  // The largest sum that is priced at once, just under 2³¹; one sixteenth more, and far more than 32 bits hold.
  expect_guide_prices({33000, 4, 3, 3, 3, 4, 4, 4}, true);
  expect_guide_prices({80000, 4, 60000}, false);
  expect_guide_prices({2880, 1000, 300, 300, 300, 200, 200, 150, 250}, false);
  expect_guide_prices({2880, 1000}, false);
}

TEST_P(EachVectorWidth, PatchesEndAtSilhouettes) {
  const Plane exemplars = noise_plane({{40, 40}}, 0, 5, false);
  Plane target = noise_plane({{20, 20}}, 0, 50, false);
  // A near disc before a far plain before the sky.
  Grid<float> depth(20, 20, 9000.0F);
  const auto near_disc = [](int x, int y) { return (x - 9) * (x - 9) + (y - 12) * (y - 12) < 20; };
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) {
      if (near_disc(x, y)) depth(x, y) = 1000.0F;
      if (y < 5) depth(x, y) = std::numeric_limits<float>::infinity();
    }
  }
  LevelState state(settings_for_level(2, 1, 240, 1.0), {}, classes, exemplars, target, make_links(depth, target, 1.04F));
  start_from_picks(state);
  const KernelView view = state.view(0);
  // The disc is convex and the sky is one: inside a window a surface is what has the same depth, except where the disc cuts the
  // plain in two, which these pixels' windows do not show.
  for (const auto& [x, y] : {std::pair{9, 12}, {9, 9}, {12, 14}, {5, 4}, {5, 5}, {15, 6}, {13, 8}, {0, 0}, {19, 19}}) {
    auto counts = whole_patch();
    for (int dy = -3; dy <= 3; ++dy) {
      for (int dx = -3; dx <= 3; ++dx) {
        if (depth.contains(x + dx, y + dy)) {
          counts[static_cast<std::size_t>(dy + 3)][static_cast<std::size_t>(dx + 3)] = depth(x + dx, y + dy) == depth(x, y);
        }
      }
    }
    const std::uint32_t pixel = target.index(0, x, y);
    EXPECT_EQ(patch_cost(view, pixel, exemplars.index(0, 20, 20)),
              naive_patch_cost(target, pixel, exemplars, exemplars.index(0, 20, 20), counts))
        << x << ", " << y;
  }
}

// One sub-pass against an exhaustive search with the same prices, summed plainly: every pixel must end at the cheapest of all that it may
// copy, and nothing else may change.
void expect_cheapest_candidates(bool with_silhouettes) {
  const Plane exemplars = noise_plane({{26, 18}, {11, 30}}, 3, 5, true);
  Plane target = noise_plane({{21, 23}}, 3, 50, true);
  // Weights so low that the bins' discounts bring prices below 0.
  const std::vector<GuideRole> guides{{4}, {2}, {1}};
  LevelSettings settings = settings_for_level(1, 1, 240, 1.0);
  settings.draws = 4;
  // Upright bands at different depths.
  Grid<float> depth(21, 23, 1000.0F);
  for (int y = 0; y < 23; ++y) {
    for (int x = 0; x < 21; ++x) depth(x, y) = 1000.0F + 100.0F * static_cast<float>(x / 3);
  }
  const auto same_surface = [&](int x, int y, int dx) { return !with_silhouettes || depth.clamped(x + dx, y) == depth(x, y); };
  LevelState state(settings, guides, classes, exemplars, target,
                   with_silhouettes ? make_links(depth, target, 1.04F) : std::vector<std::uint8_t>(),
                   SurroundingsPrice(40, {0, 16, 5, 16, 0, 9, 5, 9, 0}, classes));
  // So few uses allowed that some candidates drop out.
  std::fill(state.most_uses.begin(), state.most_uses.end(), 2U);
  start_from_picks(state);
  // Passes before it, so that there are pieces and used bins; at silhouettes none, as fresh picks are easily beaten by a neighbour.
  for (int pass = 0; pass < (with_silhouettes ? 0 : 2); ++pass) {
    state.pieces.find(target, exemplars, state.match);
    for (int s = 0; s < 4; ++s) sub_pass(state, pass, s & 1, s >> 1);
  }
  state.pieces.find(target, exemplars, state.match);
  const Plane target_before = target;
  const LevelState before = state;
  const TexelRecords records_before = state.texels;  // copies of a state share their source
  const int pass = 2;
  sub_pass(state, pass, 1, 0);

  KernelView view = before.view(pass);
  view.target = &target_before;
  view.texels = &records_before;
  std::vector<std::int32_t> bin_cost = bin_penalties(before.bins_actual, before.bins_expected, static_cast<std::int32_t>(price::bin));
  for (std::size_t i = 0; i < bin_cost.size(); ++i) {
    ASSERT_LT(std::abs(before.bin_cost_kept[i] + bin_cost[i] / 16), 30000);
    bin_cost[i] += before.bin_cost_kept[i] + bin_cost[i] / 16;
  }
  const std::vector<Surroundings> offered_around = make_surroundings(exemplars, settings.surroundings_radius, classes);
  int moved = 0;
  for (int y = 0; y < 23; ++y) {
    for (int x = 0; x < 21; ++x) {
      const std::uint32_t pixel = target.index(0, x, y);
      if (x % 2 != 1 || y % 2 != 0 || class_of(target_before.words[pixel]) == no_class) {
        ASSERT_EQ(state.match[pixel], before.match[pixel]);
        ASSERT_EQ(target.words[pixel], target_before.words[pixel]);
        continue;
      }
      const std::uint32_t c = class_of(target_before.words[pixel]);
      const Slack slack = make_slack(view, pixel);
      std::set<std::pair<std::uint32_t, std::int64_t>> candidates;  // with the price of joining; the cheapest offer comes first below
      std::set<std::uint32_t> offered;
      std::set<std::uint32_t> across;  // what runs on behind a silhouette
      for (const int dx : {-1, 1}) {
        if (!same_surface(x, y, dx))
          across.insert(static_cast<std::uint32_t>(static_cast<std::int64_t>(before.match[target.index(0, x + dx, y)]) - dx));
      }
      const auto offer = [&](std::uint32_t texel, std::int64_t join) {
        if (across.count(texel) > 0 || (records_before.at(texel).uses() >= 2 && texel != before.match[pixel])) return;
        if (class_of(exemplars.words[texel]) == c && offered.insert(texel).second) candidates.insert({texel, join});
      };
      offer(before.match[pixel], 0);
      for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}) {
        if (!same_surface(x, y, dx)) continue;
        const std::uint32_t q = target.index(0, x + dx, y + dy);
        const std::int64_t texel = static_cast<std::int64_t>(before.match[q]) - dx - dy * exemplars.stride;
        offer(static_cast<std::uint32_t>(texel), before.pieces.size()[q] >= 45 ? 60000 : 0);
      }
      offer(finish_fitting_draw(view, pixel, begin_draw(view, pixel, view.key, x, y), slack), 0);
      auto counts = whole_patch();
      for (auto& row : counts) {
        for (int dx = -3; dx <= 3; ++dx) row[static_cast<std::size_t>(dx + 3)] = same_surface(x, y, dx);
      }
      std::uint32_t best = 0;
      std::int64_t best_cost = std::numeric_limits<std::int64_t>::max();
      for (const auto& [texel, join] : candidates) {
        std::int64_t guide = 0;
        for (int g = 0; g < 3; ++g) {
          const int free = g == 0 ? slack.sorted : g == 1 ? slack.bucketed : 0;
          const std::int64_t off = std::max(0, std::abs(target.guides_at(pixel)[g] - exemplars.guides_at(texel)[g]) - free);
          guide += guides[static_cast<std::size_t>(g)].weight_q4 * off * off;
        }
        const std::int64_t n = static_cast<std::int64_t>(records_before.at(texel).uses()) - (texel == before.match[pixel] ? 1 : 0);
        const std::int64_t cost = join + (guide >> 4) + ((n * (n + 1) / 2 * before.reuse_q4[c]) >> 4) +
                                  bin_cost[c * 64 + records_before.at(texel).bin()] +
                                  before.source->around_price(before.target_around[pixel], offered_around[texel]) +
                                  naive_patch_cost(target_before, pixel, exemplars, texel, counts);
        if (cost < best_cost) {  // the set is in index order: ties go to the lower index
          best_cost = cost;
          best = texel;
        }
      }
      ASSERT_EQ(state.match[pixel], best) << x << ", " << y;
      ASSERT_EQ(target.words[pixel] & 0xffffffU, exemplars.words[best] & 0xffffffU);
      moved += best != before.match[pixel] ? 1 : 0;
    }
  }
  EXPECT_GT(moved, 5);

  // What is kept along equals a recount.
  const TexelRecords kept_along = state.texels;
  LevelState recounted = state;
  recount(recounted);
  EXPECT_TRUE(recounted.texels == kept_along);
  EXPECT_EQ(recounted.bins_actual, state.bins_actual);
}

TEST_P(EachVectorWidth, SubPassFindsTheCheapestCandidate) {
  expect_cheapest_candidates(false);
  expect_cheapest_candidates(true);
}

INSTANTIATE_TEST_SUITE_P(Vectors, EachVectorWidth, testing::ValuesIn(vector_targets()), [](const auto& name) { return name.param; });

TEST(Surroundings, AreTheCountsOfTheWindow) {
  const Plane plane = noise_plane({{150, 140}, {33, 20}}, 0, 5, true);
  for (const int radius : {2, 8}) {
    const std::vector<Surroundings> around = make_surroundings(plane, radius, classes);
    for (int p = 0; p < 2; ++p) {
      const Plane::Part& part = plane.parts[static_cast<std::size_t>(p)];
      for (int y = 0; y < part.height; y += 3) {
        for (int x = 0; x < part.width; x += 5) {
          const std::uint32_t own = class_of(plane.words[plane.index(p, x, y)]);
          if (own == no_class) continue;
          std::array<int, classes> counts{};
          for (int j = std::max(0, y - radius); j <= std::min(part.height - 1, y + radius); ++j) {
            for (int i = std::max(0, x - radius); i <= std::min(part.width - 1, x + radius); ++i) {
              const std::uint32_t c = class_of(plane.words[plane.index(p, i, j)]);
              if (c != no_class) ++counts[c];
            }
          }
          const int total = counts[0] + counts[1] + counts[2];
          const Surroundings found = around[plane.index(p, x, y)];
          ASSERT_EQ(found.others, 255 * (total - counts[own]) / total) << x << ", " << y;
          if (total == counts[own]) continue;
          ASSERT_NE(found.commonest, own);
          for (std::uint32_t c = 0; c < classes; ++c) {
            if (c != own) {
              ASSERT_GE(counts[found.commonest], counts[c]);
            }
          }
        }
      }
    }
  }
}

// Where no more than two classes meet, the price is that of all class counts.
TEST(Surroundings, PriceIsTheSquaredDifferenceOfCounts) {
  const SurroundingsPrice price(256, std::vector<std::uint8_t>(16, 16), 4);
  const auto counts = [](Surroundings s) {
    std::array<std::int64_t, 4> n{255 - s.others, 0, 0, 0};
    n[s.commonest] += s.others;
    return n;
  };
  for (int u = 0; u <= 255; u += 15) {
    for (int v = 0; v <= 255; v += 17) {
      for (const std::uint8_t a : {std::uint8_t{1}, std::uint8_t{2}}) {
        const Surroundings requested{static_cast<std::uint8_t>(u), a};
        const Surroundings offered{static_cast<std::uint8_t>(v), 2};
        std::int64_t sum = 0;
        for (std::size_t k = 0; k < 4; ++k)
          sum += (counts(requested)[k] - counts(offered)[k]) * (counts(requested)[k] - counts(offered)[k]);
        ASSERT_EQ(price(requested, offered), sum);
      }
    }
  }
  // Classes said to be alike count as one.
  const SurroundingsPrice alike(256, std::vector<std::uint8_t>(16, 0), 4);
  EXPECT_EQ(alike({100, 1}, {100, 2}), 0);
  EXPECT_EQ(alike({100, 1}, {90, 2}), 200);
}

TEST(PickLists, WindowsHoldEnoughTexelsForTheDemand) {
  const Plane exemplars = noise_plane({{60, 50}}, 2, 5, false);
  const Plane target = noise_plane({{90, 80}}, 2, 50, false);
  for (const std::vector<GuideRole>& guides : {std::vector<GuideRole>{{2880}, {200}}, std::vector<GuideRole>{{2880}, {1000}}}) {
    const PickLists lists(exemplars, count_demand(target, classes, guides), classes, guides, 16);
    std::map<std::uint32_t, int> pixel_counts;
    target.for_each([&](std::uint32_t at) { ++pixel_counts[class_of(target.words[at])]; });
    ASSERT_TRUE(lists.keys().sorted);
    ASSERT_EQ(lists.keys().bucketed, guides[1].weight_q4 == 1000) << "a guide of an eighth of the strongest one's weight";
    for (int n = 0; n < 200; ++n) {
      const std::uint32_t pixel = target.index(0, static_cast<int>(random_index(90, 1, n, 0)), static_cast<int>(random_index(80, 2, n, 0)));
      const std::uint32_t c = class_of(target.words[pixel]);
      const std::uint8_t* requested = target.guides_at(pixel);
      const PickWindow window = lists.window(c, requested);
      const auto inside = [&](const std::uint8_t* guide) {
        if (std::abs(guide[0] - requested[0]) > window.slack + 1) return false;
        return !lists.keys().bucketed || std::abs(guide[1] / 16 - requested[1] / 16) <= window.buckets;
      };
      std::int64_t texels = 0;
      std::int64_t pixels = 0;
      exemplars.for_each(
          [&](std::uint32_t at) { texels += class_of(exemplars.words[at]) == c && inside(exemplars.guides_at(at)) ? 1 : 0; });
      target.for_each([&](std::uint32_t at) { pixels += class_of(target.words[at]) == c && inside(target.guides_at(at)) ? 1 : 0; });
      EXPECT_GE(texels, 16);
      const double ratio = 1.5 * static_cast<double>(pixel_counts[c]) / static_cast<double>(lists.texel_count(c));
      EXPECT_LE(static_cast<double>(pixels), static_cast<double>(texels) * std::max(4.0, ratio));
      const std::uint32_t texel = lists.entry(lists.pick(c, requested, static_cast<std::uint32_t>(random_bits(3, n, 0))).entry(0)).texel();
      EXPECT_EQ(class_of(exemplars.words[texel]), c);
      EXPECT_TRUE(inside(exemplars.guides_at(texel)));
    }
  }
}

TEST(Bins, WhatStaysTooOftenGrowsDearerUpToABound) {
  // Used twice as often as expected, as often, never: 15000, 0 and -15000 at once, a sixteenth more each round.
  const std::vector<std::int32_t> expected{9996, 996, 9996};
  const std::vector<std::int32_t> actual{19996, 996, 0};
  std::vector<std::int32_t> kept(3, 0);
  for (int round = 1; round <= 40; ++round) {
    const std::vector<std::int32_t> costs = steer_bins(actual, expected, 15000, kept);
    EXPECT_EQ(costs[0], 15000 + std::min(30000, round * 937));
    EXPECT_EQ(costs[1], 0);
    // 16 × 9996 / 10000, towards zero, is 15 sixteenths.
    EXPECT_EQ(costs[2], -14062 - std::min(30000, round * 878));
  }
}

TEST(Bins, ABorderOfClassesIsNoContrast) {
  // Class 0: above, calm; below, restless; on its right a class that is far brighter.
  Plane exemplars = make_plane({{40, 40}}, 0);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const std::uint32_t grey = x >= 20 ? 250U : y < 20 ? 100U + static_cast<std::uint32_t>((x ^ y) & 1) : 80U + 40U * ((x ^ y) & 1);
      exemplars.words[exemplars.index(0, x, y)] = grey * 0x010101U | (x >= 20 ? 1U << 24 : 0U);
    }
  }
  pad(exemplars);
  const std::vector<std::uint8_t> bins = make_bins(exemplars, 2);
  const auto contrast = [&](int x, int y) { return bins[exemplars.index(0, x, y)] % 8; };
  for (int y = 4; y < 16; ++y) {
    EXPECT_EQ(contrast(19, y), contrast(8, y)) << y;
    EXPECT_LT(contrast(19, y), std::min(contrast(8, y + 20), contrast(19, y + 20))) << y;
  }
}

// A draw looks at texels that follow each other in the list: all of a window's bucket once, whatever the beginning, each with what it is
// chosen by, and the cheapest of as many as are drawn wins.
TEST(PickLists, DrawsAreTheCheapestOfTheirRun) {
  const Plane exemplars = noise_plane({{40, 30}, {25, 33}}, 5, 5, true);
  Plane target = noise_plane({{31, 29}}, 5, 50, true);
  const std::vector<GuideRole> guides{{2880}, {1000}, {300}, {200}, {200}};
  LevelSettings settings = settings_for_level(1, 1, 240, 1.0);
  settings.draws = 4;
  settings.border_draws = 7;
  settings.fitting_draws = 7;
  LevelState state(settings, guides, classes, exemplars, target, {}, SurroundingsPrice(40, {0, 16, 5, 16, 0, 9, 5, 9, 0}, classes));
  const std::vector<Surroundings> around = make_surroundings(exemplars, settings.surroundings_radius, classes);
  const KernelView view = state.view(0);
  const auto grey = [](std::uint32_t word) {
    return static_cast<std::int64_t>((word & 255U) + 2 * (word >> 8 & 255U) + (word >> 16 & 255U)) / 4;
  };
  int better_than_first = 0;
  int fitting = 0;
  int wrapped = 0;
  target.for_each([&](std::uint32_t pixel) {
    const std::uint32_t c = class_of(target.words[pixel]);
    if (c == no_class) return;
    const PickRun run = begin_draw(view, pixel, 77, static_cast<int>(pixel), 3);
    ASSERT_GT(run.count, 0U);
    const int draws = state.target_around[pixel].others > border_others ? 7 : 4;
    wrapped += run.start + static_cast<std::uint32_t>(draws) > run.count ? 1 : 0;
    Slack slack = make_slack(view, pixel);
    slack.others = nullptr;
    std::set<std::uint32_t> seen;
    std::uint32_t best = 0;
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    std::uint32_t best_fit = 0;
    std::int64_t least_fit = least;
    for (std::uint32_t i = 0; i < run.count; ++i) {
      const std::uint32_t texel = state.lists.entry(run.entry(i)).texel();
      ASSERT_TRUE(seen.insert(texel).second) << "a texel stands twice in a run";
      ASSERT_EQ(class_of(exemplars.words[texel]), c);
      const std::uint8_t* of_texel = exemplars.guides_at(texel);
      ASSERT_TRUE(std::equal(of_texel, of_texel + 5, state.lists.entry(run.entry(i)).guides()));
      ASSERT_TRUE(std::equal(of_texel, of_texel + 5, state.texels.at(texel).guides()));
      if (i >= 7) continue;
      const std::int64_t cost = guide_cost(view, target.guides_at(pixel), of_texel, slack) +
                                state.source->around_price(state.target_around[pixel], around[texel]);
      std::int64_t squares = 0;
      for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
          if (!(std::abs(dx * dy) == 1 || (dx * dy == 0 && std::abs(dx + dy) == 2))) continue;
          const std::int64_t step_target = dx + static_cast<std::int64_t>(dy) * target.stride;
          const std::int64_t step_texel = dx + static_cast<std::int64_t>(dy) * exemplars.stride;
          const std::uint32_t requested = target.words[static_cast<std::size_t>(pixel + step_target)];
          if (class_of(requested) == no_class) continue;
          const std::int64_t off = grey(requested) - grey(exemplars.words[static_cast<std::size_t>(texel + step_texel)]);
          squares += off * off;
        }
      }
      if (cost + price::grey * squares < least_fit) {
        least_fit = cost + price::grey * squares;
        best_fit = texel;
      }
      if (i >= static_cast<std::uint32_t>(draws) || cost >= least) continue;
      least = cost;
      best = texel;
    }
    better_than_first += best != state.lists.entry(run.entry(0)).texel() ? 1 : 0;
    fitting += best != best_fit ? 1 : 0;
    ASSERT_EQ(finish_draw(view, pixel, run, make_slack(view, pixel)), best);
    ASSERT_EQ(finish_fitting_draw(view, pixel, run, make_slack(view, pixel)), best_fit);
  });
  EXPECT_GT(better_than_first, 100);
  EXPECT_GT(fitting, 100);
  EXPECT_GT(wrapped, 10);
}

TEST(Pieces, EqualAFloodFillForAnyBand) {
  const Plane exemplars = noise_plane({{150, 140}}, 0, 5, false);
  const Plane target = noise_plane({{70, 140}}, 0, 50, false);  // several bands of rows
  std::vector<std::uint32_t> match(target.words.size(), exemplars.nowhere());
  // Blocks of constant offset that touch in all ways.
  const auto offset = [](int x, int y) { return static_cast<int>(random_index(3, 11, x / 6, y / 9)); };
  for (int y = 0; y < 140; ++y) {
    for (int x = 0; x < 70; ++x) match[target.index(0, x, y)] = exemplars.index(0, x + 9 * offset(x, y), y);
  }
  Pieces pieces(target);
  pieces.find(target, exemplars, match);
  Grid<int> seen(70, 140, -1);
  std::uint32_t largest = 0;
  for (int y = 0; y < 140; ++y) {
    for (int x = 0; x < 70; ++x) {
      if (seen(x, y) >= 0) continue;
      std::vector<std::pair<int, int>> open{{x, y}};
      seen(x, y) = 1;
      for (std::size_t i = 0; i < open.size(); ++i) {
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          const int nx = open[i].first + dx;
          const int ny = open[i].second + dy;
          if (!seen.contains(nx, ny) || seen(nx, ny) >= 0 || offset(nx, ny) != offset(x, y)) continue;
          seen(nx, ny) = 1;
          open.emplace_back(nx, ny);
        }
      }
      largest = std::max(largest, static_cast<std::uint32_t>(open.size()));
      for (const auto& [px, py] : open) {
        ASSERT_EQ(pieces.size()[target.index(0, px, py)], open.size());
        ASSERT_EQ(pieces.first_pixel(target.index(0, px, py)), target.index(0, x, y));
      }
    }
  }
  EXPECT_EQ(pieces.largest(), largest);
  EXPECT_GT(largest, 64U);
}

TEST(Replacement, MovesPiecesWholeAndWithinTheirClass) {
  const Plane exemplars = noise_plane({{150, 120}}, 1, 5, false);
  Plane target = make_plane({{60, 50}}, 1);
  const LevelSettings settings = settings_for_level(0, 1, 100, 1.0);
  // The target is a part of the exemplar, and copied from there in one.
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 60; ++x) {
      target.words[target.index(0, x, y)] = exemplars.words[exemplars.index(0, x + 40, y + 30)] & 0xff000000U;
      target.guides[target.index(0, x, y)] = exemplars.guides[exemplars.index(0, x + 40, y + 30)];
    }
  }
  pad(target);
  LevelState state(settings, {GuideRole{2880}}, classes, exemplars, target, {});
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 60; ++x) state.match[target.index(0, x, y)] = exemplars.index(0, x + 40, y + 30);
  }
  recount(state);
  state.pieces.find(target, exemplars, state.match);
  ASSERT_EQ(state.pieces.largest(), 3000U);
  const std::vector<std::uint32_t> before = state.match;
  ASSERT_TRUE(replace_pieces(state, 5, 0));
  int moved = 0;
  target.for_each([&](std::uint32_t at) {
    ASSERT_EQ(class_of(exemplars.words[state.match[at]]), class_of(target.words[at]));
    ASSERT_EQ(exemplars.words[state.match[at]], target.words[at]);
    moved += state.match[at] != before[at] ? 1 : 0;
  });
  // Half of the cells move, with the members that keep their class: a third by chance, fewer here as noise is dearer than a misfit.
  EXPECT_GT(moved, 3000 / 16);
  EXPECT_LT(moved, 3000 * 3 / 4);
  const TexelRecords kept_along = state.texels;
  LevelState recounted = state;
  recount(recounted);
  EXPECT_TRUE(recounted.texels == kept_along);
  EXPECT_EQ(recounted.bins_actual, state.bins_actual);
  ASSERT_TRUE(replace_pieces(state, 5, 1));
  EXPECT_LT(state.pieces.largest(), 3000U);
  state.settings.copy_cap = 3000;
  EXPECT_FALSE(replace_pieces(state, 5, 2)) << "nothing is over the cap";
}

TEST(Plane, StepsOutOfAPictureLandOnNoClass) {
  const Plane plane = noise_plane({{5, 7}, {9, 3}, {1, 1}}, 2, 5, false);
  for (int p = 0; p < 3; ++p) {
    const Plane::Part& part = plane.parts[static_cast<std::size_t>(p)];
    for (int y = -padding; y < part.height + padding; ++y) {
      for (int x = -padding; x < part.width + padding; ++x) {
        const bool inside = x >= 0 && y >= 0 && x < part.width && y < part.height;
        const std::uint32_t at = plane.index(p, x, y);
        ASSERT_EQ(class_of(plane.words[at]) != no_class, inside);
        if (!inside) continue;
        const Plane::Place place = plane.place(at);
        ASSERT_EQ(std::make_tuple(place.part, place.x, place.y), std::make_tuple(p, x, y));
      }
    }
  }
}

TEST(Plane, HalvesByClassAndMean) {
  Plane plane = make_plane({{5, 4}}, 1);
  plane.for_each([&](std::uint32_t at) {
    plane.words[at] = 0x02804020U;
    plane.guides[at] = 77;
  });
  plane.words[plane.index(0, 0, 0)] = 0x01ffffffU;
  plane.words[plane.index(0, 1, 1)] = 0x01ffffffU;  // two of two: the lower class
  plane.words[plane.index(0, 3, 3)] = 0xff123456U;  // excluded: its colour counts nowhere
  pad(plane);
  const Plane coarse = halve(plane);
  EXPECT_EQ(coarse.parts[0].width, 3);
  EXPECT_EQ(coarse.parts[0].height, 2);
  EXPECT_EQ(class_of(coarse.words[coarse.index(0, 0, 0)]), 1U);
  EXPECT_EQ(coarse.words[coarse.index(0, 2, 1)], 0x02804020U);
  EXPECT_EQ(coarse.words[coarse.index(0, 1, 1)] >> 24, 2U);
  coarse.for_each([&](std::uint32_t at) { EXPECT_EQ(coarse.guides[at], 77); });
}

}  // namespace
}  // namespace belvedere::synth
