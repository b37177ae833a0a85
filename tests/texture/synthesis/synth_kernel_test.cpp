#include "texture/synthesis/synth_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "tests/texture/synthesis/noise_plane.h"
#include "texture/synthesis/synth_level.h"
#include "texture/synthesis/synth_lists.h"

namespace belvedere::synth {
namespace {

using namespace test;

// The price of a patch, directly by the formula.
std::int64_t naive_patch_cost(const Plane& target, std::uint32_t pixel, const Plane& exemplars,
                              std::uint32_t texel,
                              const std::array<std::array<bool, 7>, 7>& counts) {
  std::int64_t sum = 0;
  std::int64_t mismatches = 0;
  for (int dy = -3; dy <= 3; ++dy)
    for (int dx = -3; dx <= 3; ++dx) {
      const std::uint32_t a = target.words[static_cast<std::size_t>(
          static_cast<std::int64_t>(pixel) + dy * target.stride + dx)];
      const std::uint32_t b = exemplars.words[static_cast<std::size_t>(
          static_cast<std::int64_t>(texel) + dy * exemplars.stride + dx)];
      if (class_of(a) == no_class ||
          !counts[static_cast<std::size_t>(dy + 3)][static_cast<std::size_t>(dx + 3)])
        continue;
      const std::int64_t weight = std::lround(16.0 * std::exp(-(dx * dx + dy * dy) / 8.0));
      for (int c = 0; c < 3; ++c) {
        const int d = static_cast<int>(a >> (8 * c) & 255U) - static_cast<int>(b >> (8 * c) & 255U);
        sum += weight * d * d;
      }
      if (class_of(a) != class_of(b)) ++mismatches;
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
  LevelState state(settings_for_level(2, 1, 240, 1.0), {GuideRole{2880}}, classes, exemplars,
                   target, {});
  start_from_picks(state);
  const KernelView view = state.view(0);
  int compared = 0;
  target.for_each([&](std::uint32_t pixel) {
    if (class_of(target.words[pixel]) == no_class) return;
    const int part = static_cast<int>(random_index(2, 7, pixel, 0));
    const Plane::Part& p = exemplars.parts[static_cast<std::size_t>(part)];
    const std::uint32_t texel = exemplars.index(
        part, static_cast<int>(random_index(static_cast<std::uint32_t>(p.width), 8, pixel, 0)),
        static_cast<int>(random_index(static_cast<std::uint32_t>(p.height), 9, pixel, 0)));
    ASSERT_EQ(patch_cost(view, pixel, texel),
              naive_patch_cost(target, pixel, exemplars, texel, whole_patch()));
    ++compared;
  });
  EXPECT_GT(compared, 300);
}

// Every size by its formula: weights, and scales that bring all sizes to the cost of 7 × 7.
TEST_P(EachVectorWidth, PatchesOfEverySizeEqualTheFormula) {
  for (const int radius : {1, 2, 3, 4, 5}) {
    const int margin = padding_for(radius);
    const Plane exemplars = noise_plane({{23, 17}, {9, 31}}, 1, 5, true, margin);
    Plane target = noise_plane({{19, 21}}, 1, 50, true, margin);
    Grid<float> depth(19, 21, 1000.0F);
    for (int y = 0; y < 21; ++y)
      for (int x = 11; x < 19; ++x) depth(x, y) = 3000.0F;
    LevelSettings settings = settings_for_level(2, 1, 240, 1.0);
    settings.patch_radius = radius;
    for (const bool with_silhouettes : {false, true}) {
      LevelState state(settings, {GuideRole{2880}}, classes, exemplars, target,
                       with_silhouettes ? make_links(depth, target, 1.04F, radius)
                                        : std::vector<std::uint8_t>());
      start_from_picks(state);
      const KernelView view = state.view(0);
      std::int64_t weights = 0;
      const auto weight = [radius](int dx, int dy) {
        return std::lround(16.0 * std::exp(-9.0 * (dx * dx + dy * dy) / (8.0 * radius * radius)));
      };
      for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) weights += weight(dx, dy);
      const std::int64_t scale_q8 = std::lround(256.0 * 348.0 / static_cast<double>(weights));
      const int side = 2 * radius + 1;
      const std::int64_t mismatch =
          std::lround(24000.0 * 49.0 / (side * side) * 256.0 / static_cast<double>(scale_q8));
      for (int y = 0; y < 21; ++y)
        for (int x = 0; x < 19; ++x) {
          const std::uint32_t pixel = target.index(0, x, y);
          if (class_of(target.words[pixel]) == no_class) continue;
          const std::uint32_t texel = exemplars.index(0, (3 * x + y) % 23, (5 * y + x) % 17);
          std::int64_t sum = 0;
          for (int dy = -radius; dy <= radius; ++dy)
            for (int dx = -radius; dx <= radius; ++dx) {
              const std::uint32_t a = target.words[static_cast<std::size_t>(
                  static_cast<std::int64_t>(pixel) + dy * target.stride + dx)];
              const std::uint32_t b = exemplars.words[static_cast<std::size_t>(
                  static_cast<std::int64_t>(texel) + dy * exemplars.stride + dx)];
              if (class_of(a) == no_class ||
                  (with_silhouettes && depth.clamped(x + dx, y) != depth(x, y)))
                continue;
              for (int c = 0; c < 3; ++c) {
                const int d =
                    static_cast<int>(a >> (8 * c) & 255U) - static_cast<int>(b >> (8 * c) & 255U);
                sum += weight(dx, dy) * d * d;
              }
              if (class_of(a) != class_of(b)) sum += mismatch;
            }
          ASSERT_EQ(patch_cost(view, pixel, texel), (sum * scale_q8 >> 8) >> 3)
              << side << " × " << side << " at " << x << ", " << y;
        }
    }
  }
}

TEST_P(EachVectorWidth, BlackAgainstWhiteDoesNotOverflow) {
  Plane exemplars = make_plane({{7, 7}}, 0);
  exemplars.for_each([&](std::uint32_t at) { exemplars.words[at] = 0x00ffffffU; });
  pad(exemplars);
  Plane target = make_plane({{7, 7}}, 0);
  target.for_each([&](std::uint32_t at) { target.words[at] = 0xfe000000U; });
  pad(target);
  const KernelView view{.target = &target, .exemplars = &exemplars};
  std::int64_t weights = 0;
  for (int dy = -3; dy <= 3; ++dy)
    for (int dx = -3; dx <= 3; ++dx)
      weights += std::lround(16.0 * std::exp(-(dx * dx + dy * dy) / 8.0));
  EXPECT_EQ(patch_cost(view, target.index(0, 3, 3), exemplars.index(0, 3, 3)),
            (weights * 3 * 255 * 255 >> 3) + 49 * 3000);
}

// The normalized distance in plain arithmetic: the mean of all differences of colour is left out,
// so a patch costs nothing against itself and against itself in other light.
TEST_P(EachVectorWidth, NormalizedDistanceLeavesOutTheMean) {
  const Plane exemplars = noise_plane({{23, 17}}, 0, 5, false);
  Plane target = noise_plane({{19, 21}}, 0, 50, true);
  KernelView view;
  view.target = &target;
  view.exemplars = &exemplars;
  view.normalized = true;
  const std::uint32_t texel = exemplars.index(0, 9, 8);
  for (const auto& [x, y] : {std::pair{9, 9}, {0, 0}, {18, 3}}) {
    std::int64_t squares = 0, sum = 0, weights = 0, mismatches = 0;
    for (int dy = -3; dy <= 3; ++dy)
      for (int dx = -3; dx <= 3; ++dx) {
        const std::uint32_t b =
            target
                .words[target.index(0, x, y) + static_cast<std::uint32_t>(dy * target.stride + dx)];
        const std::uint32_t a =
            exemplars.words[texel + static_cast<std::uint32_t>(dy * exemplars.stride + dx)];
        if (class_of(b) == no_class) continue;
        const std::int64_t w = std::lround(16.0 * std::exp(-(dx * dx + dy * dy) / 8.0));
        for (int c = 0; c < 24; c += 8) {
          const std::int64_t d =
              static_cast<std::int64_t>(a >> c & 255U) - static_cast<std::int64_t>(b >> c & 255U);
          squares += w * d * d;
          sum += w * d;
          weights += w;
        }
        mismatches += class_of(a) != class_of(b) ? 1 : 0;
      }
    ASSERT_GT(weights, 0);
    EXPECT_EQ(patch_cost(view, target.index(0, x, y), texel),
              (squares + mismatches * 8 * 3000 - sum * sum / weights) >> 3);
  }
  // The same patch, and the same 40 levels lighter: noise of 0 … 127.
  Plane dark = noise_plane({{23, 17}}, 0, 5, false);
  for (std::uint32_t& word : dark.words) word &= 0xff7f7f7fU;
  Plane light = dark;
  for (std::uint32_t& word : light.words) word += 0x00282828U;
  view.exemplars = &dark;
  for (const int radius : {1, 2, 3}) {
    view.radius = radius;
    view.target = &dark;
    EXPECT_EQ(patch_cost(view, texel, texel), 0);
    view.target = &light;
    EXPECT_EQ(patch_cost(view, texel, texel), 0);
    view.normalized = false;
    EXPECT_GT(patch_cost(view, texel, texel), 0);
    view.target = &dark;
    EXPECT_EQ(patch_cost(view, texel, texel), 0);
    view.normalized = true;
  }
}

// The formula of the guides' price, and which method computes it. `weights` in sixteenths.
void expect_guide_prices(const std::vector<std::int64_t>& weights, bool at_once) {
  const int count = static_cast<int>(weights.size());
  Plane exemplars = noise_plane({{23, 17}, {9, 31}}, count, 5, false);
  Plane target = noise_plane({{19, 21}}, count, 50, false);
  // The most expensive texel: every guide off by 255.
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
          const std::int64_t free = g == 0       ? slack.sorted
                                    : g == 1     ? slack.bucketed
                                    : with_slack ? slack.others[g]
                                                 : 0;
          const std::int64_t off = std::max<std::int64_t>(
              0, std::abs(target.guides_at(pixel)[g] - exemplars.guides_at(texel)[g]) - free);
          sum += weights[static_cast<std::size_t>(g)] * off * off;
        }
        ASSERT_EQ(guides_cost(view, pixel, texel), sum >> 4)
            << count << " guides, pixel " << pixel << ", texel " << texel;
        ASSERT_EQ(guide_cost(view, target.guides_at(pixel), exemplars.guides_at(texel), slack),
                  sum >> 4);
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
  // The largest sum that is priced at once, just under 2³¹; one sixteenth more, and far more than
  // 32 bits hold.
  expect_guide_prices({33000, 4, 3, 3, 3, 4, 4, 4}, true);
  expect_guide_prices({80000, 4, 60000}, false);
  expect_guide_prices({2880, 1000, 300, 300, 300, 200, 200, 150, 250}, false);
  expect_guide_prices({2880, 1000}, false);
}

TEST_P(EachVectorWidth, PatchesEndAtSilhouettes) {
  const Plane exemplars = noise_plane({{40, 40}}, 0, 5, false);
  Plane target = noise_plane({{20, 20}}, 0, 50, false);
  // A near disc in front of a far plain in front of the sky.
  Grid<float> depth(20, 20, 9000.0F);
  const auto near_disc = [](int x, int y) { return (x - 9) * (x - 9) + (y - 12) * (y - 12) < 20; };
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) {
      if (near_disc(x, y)) depth(x, y) = 1000.0F;
      if (y < 5) depth(x, y) = std::numeric_limits<float>::infinity();
    }
  LevelState state(settings_for_level(2, 1, 240, 1.0), {}, classes, exemplars, target,
                   make_links(depth, target, 1.04F));
  start_from_picks(state);
  const KernelView view = state.view(0);
  // The disc is convex and so is the sky: inside a window a surface is the set of pixels with one
  // depth, unless the disc divides the plain, which does not happen in the windows of these pixels.
  for (const auto& [x, y] :
       {std::pair{9, 12}, {9, 9}, {12, 14}, {5, 4}, {5, 5}, {15, 6}, {13, 8}, {0, 0}, {19, 19}}) {
    auto counts = whole_patch();
    for (int dy = -3; dy <= 3; ++dy)
      for (int dx = -3; dx <= 3; ++dx)
        if (depth.contains(x + dx, y + dy)) {
          counts[static_cast<std::size_t>(dy + 3)][static_cast<std::size_t>(dx + 3)] =
              depth(x + dx, y + dy) == depth(x, y);
        }
    const std::uint32_t pixel = target.index(0, x, y);
    EXPECT_EQ(patch_cost(view, pixel, exemplars.index(0, 20, 20)),
              naive_patch_cost(target, pixel, exemplars, exemplars.index(0, 20, 20), counts))
        << x << ", " << y;
  }
}

// Texels of a part that lacks guides cost its constant price and the guides that it knows, by both
// methods.
TEST_P(EachVectorWidth, LackedGuidesCostTheirPrice) {
  for (const int count : {2, 5, 8, 9}) {
    Plane exemplars = noise_plane({{23, 17}, {9, 31}}, count, 5, false);
    Plane target = noise_plane({{19, 21}}, count, 50, false);
    const std::size_t guides = static_cast<std::size_t>(count);
    exemplars.known.assign(2 * guides + vector_guides, 255);
    exemplars.known[guides] = exemplars.known[2 * guides - 1] = 0;  // of the second part
    exemplars.lacking_price.assign(512, 0);
    for (std::size_t c = 0; c < static_cast<std::size_t>(classes); ++c)
      exemplars.lacking_price[256 + c] = 1000 * static_cast<std::int64_t>(c + 1);
    const std::vector<GuideRole> roles(guides, {64});
    LevelState state(settings_for_level(1, 1, 240, 1.0), roles, classes, exemplars, target, {});
    const KernelView view = state.view(0);
    const std::uint32_t pixel = target.index(0, 9, 9);
    const Slack slack = make_slack(view, pixel);
    const std::uint32_t c = class_of(target.words[pixel]);
    int seen = 0;
    exemplars.for_each([&](std::uint32_t texel) {
      if (class_of(exemplars.words[texel]) != c) return;
      const bool second = texel >= exemplars.parts[1].origin;
      std::int64_t sum = 0;
      for (int g = 0; g < count; ++g) {
        if (second && (g == 0 || g == count - 1)) continue;
        const std::int64_t free = g == 0 ? slack.sorted : g == 1 ? slack.bucketed : slack.others[g];
        const std::int64_t off = std::max<std::int64_t>(
            0, std::abs(target.guides_at(pixel)[g] - exemplars.guides_at(texel)[g]) - free);
        sum += 64 * off * off;
      }
      const std::int64_t price = second ? 1000 * static_cast<std::int64_t>(c + 1) : 0;
      ASSERT_EQ(guides_cost(view, pixel, texel), (sum >> 4) + price) << count << ", " << texel;
      seen += second ? 1 : 0;
    });
    EXPECT_GT(seen, 10);
  }
}

// One sub-pass against an exhaustive search with the same prices: every pixel must end at the
// cheapest of all that it may copy, and nothing else may change.
void expect_cheapest_candidates(bool with_silhouettes) {
  const Plane exemplars = noise_plane({{26, 18}, {11, 30}}, 3, 5, true);
  Plane target = noise_plane({{21, 23}}, 3, 50, true);
  // Weights low enough for the bins' discounts to bring prices below 0.
  const std::vector<GuideRole> guides{{4}, {2}, {1}};
  LevelSettings settings = settings_for_level(1, 1, 240, 1.0);
  settings.draws = 4;
  // Vertical bands at different depths.
  Grid<float> depth(21, 23, 1000.0F);
  for (int y = 0; y < 23; ++y)
    for (int x = 0; x < 21; ++x) depth(x, y) = 1000.0F + 100.0F * static_cast<float>(x / 3);
  const auto same_surface = [&](int x, int y, int dx) {
    return !with_silhouettes || depth.clamped(x + dx, y) == depth(x, y);
  };
  LevelState state(
      settings, guides, classes, exemplars, target,
      with_silhouettes ? make_links(depth, target, 1.04F) : std::vector<std::uint8_t>(),
      SurroundingsPrice(40, {0, 16, 5, 16, 0, 9, 5, 9, 0}, classes));
  // So few uses allowed that some candidates are excluded.
  std::fill(state.max_uses.begin(), state.max_uses.end(), 2U);
  start_from_picks(state);
  // Earlier passes, so that there are pieces and used bins; none at silhouettes, where a neighbour
  // easily beats fresh picks.
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
  std::vector<std::int32_t> bin_cost = bin_penalties(before.bins_actual, before.bins_expected,
                                                     static_cast<std::int32_t>(price::bin));
  for (std::size_t i = 0; i < bin_cost.size(); ++i) {
    ASSERT_LT(std::abs(before.bin_cost_kept[i] + bin_cost[i] / 16), 30000);
    bin_cost[i] += before.bin_cost_kept[i] + bin_cost[i] / 16;
  }
  const std::vector<Surroundings> offered_around =
      make_surroundings(exemplars, settings.surroundings_radius, classes);
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
      std::set<std::pair<std::uint32_t, std::int64_t>>
          candidates;  // with the price of joining; the cheapest offer comes first below
      std::set<std::uint32_t> offered;
      std::set<std::uint32_t> across;  // pieces that continue behind a silhouette
      for (const int dx : {-1, 1})
        if (!same_surface(x, y, dx))
          across.insert(static_cast<std::uint32_t>(
              static_cast<std::int64_t>(before.match[target.index(0, x + dx, y)]) - dx));
      const auto offer = [&](std::uint32_t texel, std::int64_t join) {
        if (across.count(texel) > 0 ||
            (records_before.at(texel).uses() >= 2 && texel != before.match[pixel]))
          return;
        if (class_of(exemplars.words[texel]) == c && offered.insert(texel).second)
          candidates.insert({texel, join});
      };
      offer(before.match[pixel], 0);
      for (const auto& [dx, dy] :
           {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}) {
        if (!same_surface(x, y, dx)) continue;
        const std::uint32_t q = target.index(0, x + dx, y + dy);
        const std::int64_t texel =
            static_cast<std::int64_t>(before.match[q]) - dx - dy * exemplars.stride;
        offer(static_cast<std::uint32_t>(texel), before.pieces.size()[q] >= 45 ? 60000 : 0);
      }
      offer(finish_fitting_draw(view, pixel, begin_draw(view, pixel, view.key, x, y), slack), 0);
      auto counts = whole_patch();
      for (auto& row : counts)
        for (int dx = -3; dx <= 3; ++dx)
          row[static_cast<std::size_t>(dx + 3)] = same_surface(x, y, dx);
      std::uint32_t best = 0;
      std::int64_t best_cost = std::numeric_limits<std::int64_t>::max();
      for (const auto& [texel, join] : candidates) {
        std::int64_t guide = 0;
        for (int g = 0; g < 3; ++g) {
          const int free = g == 0 ? slack.sorted : g == 1 ? slack.bucketed : 0;
          const std::int64_t off = std::max(
              0, std::abs(target.guides_at(pixel)[g] - exemplars.guides_at(texel)[g]) - free);
          guide += guides[static_cast<std::size_t>(g)].weight_q4 * off * off;
        }
        const std::int64_t n = static_cast<std::int64_t>(records_before.at(texel).uses()) -
                               (texel == before.match[pixel] ? 1 : 0);
        const std::int64_t cost =
            join + (guide >> 4) + ((n * (n + 1) / 2 * before.reuse_q4[c]) >> 4) +
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

  // Running sums equal a recount.
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

INSTANTIATE_TEST_SUITE_P(Vectors, EachVectorWidth, testing::ValuesIn(vector_targets()),
                         [](const auto& name) { return name.param; });

}  // namespace
}  // namespace belvedere::synth
