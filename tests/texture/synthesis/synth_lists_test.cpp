#include "texture/synthesis/synth_lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <vector>

#include "base/random.h"
#include "tests/texture/synthesis/noise_plane.h"
#include "texture/synthesis/synth_kernel.h"
#include "texture/synthesis/synth_level.h"

namespace belvedere::synth {
namespace {

using namespace test;

TEST(PickLists, WindowsHoldEnoughTexelsForTheDemand) {
  const Plane exemplars = noise_plane({{60, 50}}, 2, 5, false);
  const Plane target = noise_plane({{90, 80}}, 2, 50, false);
  for (const std::vector<GuideRole>& guides :
       {std::vector<GuideRole>{{2880}, {200}}, std::vector<GuideRole>{{2880}, {1000}}}) {
    const PickLists lists(exemplars, count_texel_demand(target, classes, guides), classes, guides,
                          16);
    std::map<std::uint32_t, int> pixel_counts;
    target.for_each([&](std::uint32_t at) { ++pixel_counts[class_of(target.words[at])]; });
    ASSERT_TRUE(lists.keys().sorted);
    ASSERT_EQ(lists.keys().bucketed, guides[1].weight_q4 == 1000)
        << "a guide of an eighth of the strongest one's weight";
    for (int n = 0; n < 200; ++n) {
      const std::uint32_t pixel = target.index(0, static_cast<int>(random_index(90, 1, n, 0)),
                                               static_cast<int>(random_index(80, 2, n, 0)));
      const std::uint32_t c = class_of(target.words[pixel]);
      const std::uint8_t* requested = target.guides_at(pixel);
      const PickWindow window = lists.window(c, requested);
      const auto inside = [&](const std::uint8_t* guide) {
        if (std::abs(guide[0] - requested[0]) > window.slack + 1) return false;
        return !lists.keys().bucketed ||
               std::abs(guide[1] / 16 - requested[1] / 16) <= window.buckets;
      };
      std::int64_t texels = 0;
      std::int64_t pixels = 0;
      exemplars.for_each([&](std::uint32_t at) {
        texels += class_of(exemplars.words[at]) == c && inside(exemplars.guides_at(at)) ? 1 : 0;
      });
      target.for_each([&](std::uint32_t at) {
        pixels += class_of(target.words[at]) == c && inside(target.guides_at(at)) ? 1 : 0;
      });
      EXPECT_GE(texels, 16);
      const double ratio =
          1.5 * static_cast<double>(pixel_counts[c]) / static_cast<double>(lists.texel_count(c));
      EXPECT_LE(static_cast<double>(pixels), static_cast<double>(texels) * std::max(4.0, ratio));
      const std::uint32_t texel =
          lists
              .entry(lists.pick(c, requested, static_cast<std::uint32_t>(random_bits(3, n, 0)))
                         .entry(0))
              .texel();
      EXPECT_EQ(class_of(exemplars.words[texel]), c);
      EXPECT_TRUE(inside(exemplars.guides_at(texel)));
    }
  }
}

// Texels of one class, bucket and value are in the order of one walk through the plane by
// golden-ratio steps, however many walks run in parallel.
TEST(PickLists, StandInTheOrderOfOneWalk) {
  const Plane exemplars = noise_plane({{60, 50}, {31, 77}}, 3, 5, true);
  const std::vector<GuideRole> guides{{2880}, {1000}, {200}};
  const PickLists lists(exemplars, count_texel_demand(exemplars, classes, guides), classes, guides,
                        16);
  std::map<std::tuple<std::uint32_t, int, int>, std::vector<std::uint32_t>> kinds;
  const std::uint64_t count = exemplars.words.size();
  std::uint64_t step = count * 618 / 1000 | 1;
  while (std::gcd(step, count) != 1) step += 2;
  for (std::uint64_t i = 0, at = 0; i < count; ++i, at = (at + step) % count) {
    const std::uint32_t c = class_of(exemplars.words[at]);
    if (c == no_class) continue;
    const std::uint8_t* values = exemplars.guides_at(static_cast<std::uint32_t>(at));
    kinds[{c, values[1] / ListKeys::bucket_width, values[0]}].push_back(
        static_cast<std::uint32_t>(at));
  }
  std::uint32_t nth = 0;
  for (const auto& [kind, texels] : kinds)
    for (const std::uint32_t texel : texels)
      ASSERT_EQ(lists.entry(nth++).texel(), texel) << "entry " << nth;
  std::int64_t all = 0;
  for (std::uint32_t c = 0; c < classes; ++c) all += lists.texel_count(c);
  EXPECT_EQ(nth, all);
}

// A draw reads consecutive texels of the list: all of a window's bucket once, whatever the start,
// each with its selection data, and the cheapest of those drawn wins.
TEST(PickLists, DrawsAreTheCheapestOfTheirRun) {
  const Plane exemplars = noise_plane({{40, 30}, {25, 33}}, 5, 5, true);
  Plane target = noise_plane({{31, 29}}, 5, 50, true);
  const std::vector<GuideRole> guides{{2880}, {1000}, {300}, {200}, {200}};
  LevelSettings settings = settings_for_level(1, 1, 240, 1.0);
  settings.draws = 4;
  settings.border_draws = 7;
  settings.fitting_draws = 7;
  LevelState state(settings, guides, classes, exemplars, target, {},
                   SurroundingsPrice(40, {0, 16, 5, 16, 0, 9, 5, 9, 0}, classes));
  const std::vector<Surroundings> around =
      make_surroundings(exemplars, settings.surroundings_radius, classes);
  const KernelView view = state.view(0);
  const auto grey = [](std::uint32_t word) {
    return static_cast<std::int64_t>((word & 255U) + 2 * (word >> 8 & 255U) + (word >> 16 & 255U)) /
           4;
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
    std::int64_t min = std::numeric_limits<std::int64_t>::max();
    std::uint32_t best_fit = 0;
    std::int64_t min_fit = min;
    for (std::uint32_t i = 0; i < run.count; ++i) {
      const std::uint32_t texel = state.lists.entry(run.entry(i)).texel();
      ASSERT_TRUE(seen.insert(texel).second) << "a texel occurs twice in a run";
      ASSERT_EQ(class_of(exemplars.words[texel]), c);
      const std::uint8_t* of_texel = exemplars.guides_at(texel);
      ASSERT_TRUE(std::equal(of_texel, of_texel + 5, state.lists.entry(run.entry(i)).guides()));
      ASSERT_TRUE(std::equal(of_texel, of_texel + 5, state.texels.at(texel).guides()));
      if (i >= 7) continue;
      const std::int64_t cost =
          guide_cost(view, target.guides_at(pixel), of_texel, slack) +
          state.source->around_price(state.target_around[pixel], around[texel]);
      std::int64_t squares = 0;
      for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
          if (!(std::abs(dx * dy) == 1 || (dx * dy == 0 && std::abs(dx + dy) == 2))) continue;
          const std::int64_t step_target = dx + static_cast<std::int64_t>(dy) * target.stride;
          const std::int64_t step_texel = dx + static_cast<std::int64_t>(dy) * exemplars.stride;
          const std::uint32_t requested =
              target.words[static_cast<std::size_t>(pixel + step_target)];
          if (class_of(requested) == no_class) continue;
          const std::int64_t off =
              grey(requested) - grey(exemplars.words[static_cast<std::size_t>(texel + step_texel)]);
          squares += off * off;
        }
      if (cost + price::grey * squares < min_fit) {
        min_fit = cost + price::grey * squares;
        best_fit = texel;
      }
      if (i >= static_cast<std::uint32_t>(draws) || cost >= min) continue;
      min = cost;
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

TEST(Bins, WhatStaysTooOftenGrowsDearerUpToABound) {
  // Used twice as often as expected, as often, never: 15000, 0 and -15000 at once, a sixteenth more
  // each round.
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
  // Class 0: above, calm; below, busy; on its right a class that is far brighter.
  Plane exemplars = make_plane({{40, 40}}, 0);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      const std::uint32_t grey = x >= 20  ? 250U
                                 : y < 20 ? 100U + static_cast<std::uint32_t>((x ^ y) & 1)
                                          : 80U + 40U * ((x ^ y) & 1);
      exemplars.words[exemplars.index(0, x, y)] = grey * 0x010101U | (x >= 20 ? 1U << 24 : 0U);
    }
  pad(exemplars);
  const std::vector<std::uint8_t> bins = make_bins(exemplars, 2);
  const auto contrast = [&](int x, int y) { return bins[exemplars.index(0, x, y)] % 8; };
  for (int y = 4; y < 16; ++y) {
    EXPECT_EQ(contrast(19, y), contrast(8, y)) << y;
    EXPECT_LT(contrast(19, y), std::min(contrast(8, y + 20), contrast(19, y + 20))) << y;
  }
}

}  // namespace
}  // namespace belvedere::synth
