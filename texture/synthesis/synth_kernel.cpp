#include "texture/synthesis/synth_kernel.h"

#include <type_traits>

#include "base/error.h"
#include "texture/synthesis/synth_pieces.h"

// This file is compiled once for each vector width by Highway.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "texture/synthesis/synth_kernel.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace belvedere::synth {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Words = hn::CappedTag<std::uint32_t, 8>;  // half or all of a patch's row
using Bytes = hn::Repartition<std::uint8_t, Words>;
using Shorts = hn::Repartition<std::int16_t, Words>;
using Sums = hn::Repartition<std::int32_t, Words>;

// Words read for a patch's row: up to 7 pixels and at least one of weight 0, or up to 11 in 16.
template <int radius>
constexpr std::size_t row_words = radius <= 3 ? 8 : 16;
template <int radius>
constexpr std::size_t patch_words = (2 * radius + 1) * row_words<radius>;
constexpr std::int64_t no_price =
    INT64_MAX / 4;  // above all others; leaves room to subtract a price below 0

// Weights as pairs of shorts for R and B of a word, and for G and the class: a difference of class,
// clamped to 1, times the price of a mismatch is added into the same sum.
template <int radius>
struct WeightTable {
  alignas(64) std::uint32_t red_blue[patch_words<radius>] = {};
  alignas(64) std::uint32_t green_class[patch_words<radius>] = {};
  constexpr WeightTable() {
    constexpr PatchShape shape = patch_shapes[radius];
    static_assert(shape.mismatch <= 32767);
    for (int j = 0; j <= 2 * radius; ++j) {
      for (int i = 0; i <= 2 * radius; ++i) {
        const std::uint32_t w =
            static_cast<std::uint32_t>(shape.weights[j < radius ? radius - j : j - radius]
                                                    [i < radius ? radius - i : i - radius]);
        const std::size_t at =
            static_cast<std::size_t>(j) * row_words<radius> + static_cast<std::size_t>(i);
        red_blue[at] = w | w << 16;
        green_class[at] = w | static_cast<std::uint32_t>(shape.mismatch) << 16;
      }
    }
  }
};
template <int radius>
constexpr WeightTable<radius> weight_table;

// A sum of weighted squares in price units.
template <int radius>
HWY_INLINE std::int64_t to_price(std::int64_t sum) {
  if constexpr (patch_shapes[radius].scale_q8 != 256)
    sum = sum * patch_shapes[radius].scale_q8 >> 8;
  return sum >> price::distance_shift;
}

// The target's patch around a pixel, loaded once for all its candidates. mask is 0 for pixels that
// do not count.
template <int radius>
struct Patch {
  alignas(64) std::uint32_t colour[patch_words<radius>];
  alignas(64) std::uint32_t mask[patch_words<radius>];
  std::int64_t weights = 0;  // 3 × those of the pixels that count; 0: the plain distance
};

template <int radius>
HWY_INLINE void LoadPatch(const KernelView& view, std::uint32_t pixel, Patch<radius>& patch) {
  constexpr std::size_t side = 2 * radius + 1;
  const Words d;
  const std::ptrdiff_t stride = view.target->stride;
  const std::uint32_t* row = view.target->words.data() + pixel - radius * stride - radius;
  for (std::size_t j = 0; j < side; ++j, row += stride) {
    for (std::size_t i = 0; i < row_words<radius>; i += hn::Lanes(d)) {
      const auto words = hn::LoadU(d, row + i);
      const auto counts = hn::Ne(hn::ShiftRight<24>(words), hn::Set(d, no_class));
      hn::Store(words, d, patch.colour + j * row_words<radius> + i);
      hn::Store(hn::VecFromMask(d, counts), d, patch.mask + j * row_words<radius> + i);
    }
  }
  if (view.links != nullptr && (view.links[pixel] & link::cut_patch)) {
    const SurfaceRows rows = surface_around(view, pixel);
    for (std::size_t j = 0; j < side; ++j)
      for (std::size_t i = 0; i < side; ++i)
        if (!(rows[j] >> i & 1)) patch.mask[j * row_words<radius> + i] = 0;
  }
  for (std::size_t at = 0; view.normalized && at < patch_words<radius>; ++at)
    if (patch.mask[at] != 0) patch.weights += 3 * (weight_table<radius>.red_blue[at] & 0xffffU);
}

// Weighted sum of the signed differences of R, G and B.
template <int radius>
HWY_INLINE std::int64_t SignedSum(const Patch<radius>& patch, const std::uint32_t* texel,
                                  std::ptrdiff_t stride) {
  const Words d;
  const Shorts d16;
  auto sum0 = hn::Zero(Sums());
  auto sum1 = sum0;
  for (std::size_t at = 0; at < patch_words<radius>; at += hn::Lanes(d)) {
    const std::ptrdiff_t y = static_cast<std::ptrdiff_t>(at / row_words<radius>) - radius;
    const auto mask = hn::Load(d, patch.mask + at);
    const auto a =
        hn::And(hn::LoadU(d, texel + y * stride - radius + at % row_words<radius>), mask);
    const auto b = hn::And(hn::Load(d, patch.colour + at), mask);
    const auto pairs = hn::Set(d, 0x00ff00ffU);
    const auto red_blue =
        hn::Sub(hn::BitCast(d16, hn::And(a, pairs)), hn::BitCast(d16, hn::And(b, pairs)));
    const auto single = hn::Set(d, 0xff00U);
    const auto green = hn::Sub(hn::BitCast(d16, hn::ShiftRight<8>(hn::And(a, single))),
                               hn::BitCast(d16, hn::ShiftRight<8>(hn::And(b, single))));
    const auto w = hn::BitCast(d16, hn::Load(d, weight_table<radius>.red_blue + at));
    sum0 = hn::ReorderWidenMulAccumulate(Sums(), red_blue, w, sum0, sum1);
    sum0 = hn::ReorderWidenMulAccumulate(Sums(), green, w, sum0, sum1);
  }
  return hn::GetLane(hn::SumOfLanes(Sums(), hn::Add(sum0, sum1)));
}

// Adds one row's weighted squared differences of R, G, B and its class mismatches.
template <int radius, class V>
HWY_INLINE void AddRow(const Patch<radius>& patch, std::size_t j, const std::uint32_t* texels,
                       V& sum0, V& sum1) {
  const Words d;
  const Bytes d8;
  const Shorts d16;
  const Sums d32;
  const auto low_bytes = hn::Set(d, 0x00ff00ffU);
  const auto green_or_one = hn::BitCast(d16, hn::Set(d, 0x000100ffU));
  for (std::size_t i = 0; i < row_words<radius>; i += hn::Lanes(d)) {
    const std::size_t at = j * row_words<radius> + i;
    const auto a = hn::BitCast(d8, hn::LoadU(d, texels + i));
    const auto b = hn::BitCast(d8, hn::Load(d, patch.colour + at));
    const auto difference =
        hn::And(hn::BitCast(d, hn::Or(hn::SaturatedSub(a, b), hn::SaturatedSub(b, a))),
                hn::Load(d, patch.mask + at));
    const auto red_blue = hn::BitCast(d16, hn::And(difference, low_bytes));
    const auto green_class =
        hn::Min(hn::BitCast(d16, hn::ShiftRight<8>(hn::BitCast(
                                     hn::Repartition<std::uint16_t, Words>(), difference))),
                green_or_one);
    const auto w_rb = hn::BitCast(d16, hn::Load(d, weight_table<radius>.red_blue + at));
    const auto w_gc = hn::BitCast(d16, hn::Load(d, weight_table<radius>.green_class + at));
    sum0 = hn::ReorderWidenMulAccumulate(d32, red_blue, hn::Mul(red_blue, w_rb), sum0, sum1);
    sum0 = hn::ReorderWidenMulAccumulate(d32, green_class, hn::Mul(green_class, w_gc), sum0, sum1);
  }
}

// Patch distance plus class mismatches, in price units; above `limit` only a partial sum may be
// returned. Normalized: Σ w (d - mean)² = Σ w d² - (Σ w d)² / Σ w.
template <int radius>
HWY_INLINE std::int64_t PatchCost(const Patch<radius>& patch, const std::uint32_t* texel,
                                  std::ptrdiff_t stride, std::int64_t limit) {
  const Sums d32;
  auto sum0 = hn::Zero(d32);
  auto sum1 = hn::Zero(d32);
  constexpr std::size_t centre = radius;
  const std::uint32_t* row = texel - radius;
  // The centre rows have most of the weight: they decide most candidates.
  AddRow<radius>(patch, centre, row, sum0, sum1);
  AddRow<radius>(patch, centre - 1, row - stride, sum0, sum1);
  AddRow<radius>(patch, centre + 1, row + stride, sum0, sum1);
  if constexpr (radius > 1) {
    const std::int64_t part =
        to_price<radius>(hn::GetLane(hn::SumOfLanes(d32, hn::Add(sum0, sum1))));
    if (part > limit && patch.weights == 0) return part;
    for (std::size_t j = 2; j <= centre; ++j) {
      AddRow<radius>(patch, centre - j, row - static_cast<std::ptrdiff_t>(j) * stride, sum0, sum1);
      AddRow<radius>(patch, centre + j, row + static_cast<std::ptrdiff_t>(j) * stride, sum0, sum1);
    }
  }
  std::int64_t sum = hn::GetLane(hn::SumOfLanes(d32, hn::Add(sum0, sum1)));
  if (patch.weights != 0) {
    const std::int64_t offset = SignedSum<radius>(patch, texel, stride);
    sum -= offset * offset / patch.weights;
  }
  return to_price<radius>(sum);
}

// The search for one pixel: candidates are offered one by one, the cheapest is kept; ties go to the
// lower exemplar index.
template <int radius>
struct Search {
  const KernelView* view = nullptr;
  std::uint32_t label_class = no_class;
  const std::uint8_t* requested = nullptr;
  Slack slack;
  alignas(8) std::uint8_t free[vector_guides] = {};  // slack of each guide, for GuideCost
  Surroundings around;
  Forbidden forbidden;
  Patch<radius> patch;
  std::uint32_t own = 0;
  std::uint32_t best = 0;
  std::int64_t best_cost = no_price;
  std::uint32_t seen[12];
  int seen_count = 0;

  HWY_INLINE void Begin(const KernelView& state, std::uint32_t pixel) {
    view = &state;
    label_class = class_of(state.target->words[pixel]);
    requested = state.target->guides_at(pixel);
    slack = make_slack(state, pixel);
    if (state.vector_weights != nullptr) {
      const int count = std::min(state.exemplars->guide_count, vector_guides);
      free[0] = static_cast<std::uint8_t>(std::min(255, slack.sorted));
      free[1] = static_cast<std::uint8_t>(std::min(255, slack.bucketed));
      for (int g = 2; g < count && slack.others != nullptr; ++g) free[g] = slack.others[g];
    }
    if (state.around_price != nullptr) around = state.target_around[pixel];
    if (state.has_cuts || (state.links != nullptr && (state.links[pixel] & link::all) != link::all))
      forbidden = forbidden_texels(state, pixel);
    own = best = state.match[pixel];
    LoadPatch<radius>(state, pixel, patch);
  }

  // guide_cost, for up to 8 guides at once where their prices fit 32 bits.
  HWY_INLINE std::int64_t GuideCost(std::uint32_t texel, const std::uint8_t* offered) const {
    const Lacking lacking = lacking_of(*view->exemplars, texel, label_class);
    if (view->vector_weights == nullptr)
      return guide_cost(*view, requested, offered, slack, lacking);
    const hn::CappedTag<std::uint32_t, 4> d32;
    const hn::CappedTag<std::uint16_t, 8> d16;
    const hn::Rebind<std::uint8_t, decltype(d16)> d8;
    const hn::Rebind<std::uint16_t, decltype(d32)> half;
    auto sum = hn::Zero(d32);
    for (std::size_t i = 0; i < vector_guides; i += hn::Lanes(d16)) {
      const auto a = hn::LoadU(d8, requested + i);
      const auto b = hn::LoadU(d8, offered + i);
      auto off = hn::SaturatedSub(hn::Or(hn::SaturatedSub(a, b), hn::SaturatedSub(b, a)),
                                  hn::LoadU(d8, free + i));
      if (lacking.known != nullptr) off = hn::And(off, hn::LoadU(d8, lacking.known + i));
      const auto wide = hn::PromoteTo(d16, off);
      alignas(16) std::uint16_t squares[vector_guides];
      hn::StoreU(hn::Mul(wide, wide), d16, squares);
      for (std::size_t k = 0; k < hn::Lanes(d16); k += hn::Lanes(d32)) {
        const auto square = hn::PromoteTo(d32, hn::LoadU(half, squares + k));
        sum = hn::Add(sum, hn::Mul(square, hn::LoadU(d32, view->vector_weights + i + k)));
      }
    }
    return static_cast<std::int64_t>(hn::GetLane(hn::SumOfLanes(d32, sum)) >> 4) + lacking.price;
  }

  HWY_INLINE std::int64_t AroundCost(Surroundings offered) const {
    return surroundings_cost(*view, around, offered);
  }

  // `join` is the cost of copying together with a neighbour's piece (or keeping the own one).
  HWY_INLINE void Offer(std::uint32_t texel, std::int64_t join) {
    const std::uint32_t* word = view->exemplars->words.data() + texel;
    if (class_of(*word) != label_class) return;
    for (int i = 0; i < seen_count; ++i)
      if (seen[i] == texel) return;
    seen[seen_count++] = texel;
    if (forbidden.count > 0 && forbidden.has(texel)) return;
    const TexelRecords::Record record = view->texels->at(texel);
    const std::int64_t others = static_cast<std::int64_t>(record.uses()) - (texel == own ? 1 : 0);
    if (others >= view->max_uses[label_class] && texel != own) return;
    std::int64_t cost = join + GuideCost(texel, record.guides()) + AroundCost(record.around()) +
                        (others * (others + 1) / 2 * view->reuse_q4[label_class] >> 4) +
                        view->bin_cost[label_class * 64 + record.bin()];
    if (cost > best_cost) return;
    cost += PatchCost<radius>(patch, word, view->exemplars->stride, best_cost - cost);
    if (cost < best_cost || (cost == best_cost && texel < best)) {
      best_cost = cost;
      best = texel;
    }
  }
};

constexpr std::ptrdiff_t fetch_ahead = 2;
constexpr int batch = 32;  // picks begun before the first is finished

template <int radius>
HWY_INLINE void Fetch(const KernelView& view, std::uint32_t texel) {
  const std::ptrdiff_t stride = view.exemplars->stride;
  const std::uint32_t* row = view.exemplars->words.data() + texel - radius * stride;
  for (int j = 0; j <= 2 * radius; ++j, row += stride) hwy::Prefetch(row);
  hwy::Prefetch(view.texels->at(texel).words);
}

template <int radius>
void ImproveRowOf(const KernelView& view, int x0, int x1, int y, std::uint32_t* next) {
  static constexpr std::array<std::array<int, 2>, 8> neighbours{
      {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
  const Plane& target = *view.target;
  const std::int64_t nearly_full = view.copy_cap - view.copy_cap / 4;
  const std::uint32_t row = target.index(0, 0, y);
  // Picks are scattered over the exemplars, and memory latency is most of their cost. So all are
  // drawn first, into `next`: list entries are prefetched a batch ahead, and texels a few pixels
  // ahead of their use.
  std::uint32_t* drawn = next;
  const std::uint32_t draws = static_cast<std::uint32_t>(std::max(view.draws, view.fitting_draws));
  for (int first = x0; first < x1; first += 2 * batch) {
    std::array<PickRun, batch> runs;
    const int last = std::min(x1, first + 2 * batch);
    for (int x = first, i = 0; x < last; x += 2, ++i) {
      const std::uint32_t pixel = row + static_cast<std::uint32_t>(x);
      if (class_of(target.words[pixel]) == no_class || view.is_fixed(pixel)) continue;
      PickRun& run = runs[static_cast<std::size_t>(i)];
      run = begin_draw(view, pixel, view.key, x, y);
      if (run.count == 0) continue;
      hwy::Prefetch(view.lists->entry(run.entry(0)).words);
      hwy::Prefetch(view.lists->entry(run.entry(std::min(run.count, draws) - 1)).words);
    }
    for (int x = first, i = 0; x < last; x += 2, ++i, ++drawn) {
      const std::uint32_t pixel = row + static_cast<std::uint32_t>(x);
      const PickRun& run = runs[static_cast<std::size_t>(i)];
      *drawn = run.count == 0 ? view.exemplars->nowhere()
                              : finish_fitting_draw(view, pixel, run, make_slack(view, pixel));
    }
  }
  for (int x = x0; x < x1; x += 2, ++next) {
    const std::uint32_t pixel = row + static_cast<std::uint32_t>(x);
    if (next + fetch_ahead < drawn) {
      Fetch<radius>(view, next[fetch_ahead]);
      // The matches of neighbours locate this pixel's coherent candidates.
      const std::uint32_t* ahead = view.match + pixel + 2 * fetch_ahead;
      for (const std::uint32_t texel :
           {ahead[0], ahead[1], *(ahead - target.stride), ahead[target.stride]}) {
        hwy::Prefetch(view.texels->at(texel).words);
        hwy::Prefetch(view.exemplars->words.data() + texel);
      }
    }
    const std::uint32_t pick = *next;
    *next = view.match[pixel];
    if (class_of(target.words[pixel]) == no_class || view.is_fixed(pixel)) continue;
    Search<radius> search;
    search.Begin(view, pixel);
    // Where pieces are not moved as a whole, a piece over the cap is broken up from inside, by
    // cells that alternate between passes.
    std::int64_t keep = 0;
    if (!view.replaces_pieces && view.piece_size[pixel] > view.copy_cap &&
        cell_around(x, y, view.key).odd == (view.pass & 1)) {
      keep = price::join;
    }
    search.Offer(view.match[pixel], keep);
    for (const auto& [dx, dy] : neighbours) {
      if (view.links != nullptr && !linked(view.links, target.stride, pixel, dx, dy)) continue;
      const std::ptrdiff_t at =
          static_cast<std::ptrdiff_t>(pixel) + dx + static_cast<std::ptrdiff_t>(dy) * target.stride;
      const std::ptrdiff_t texel = static_cast<std::ptrdiff_t>(view.match[at]) - dx -
                                   static_cast<std::ptrdiff_t>(dy) * view.exemplars->stride;
      if (!continues(view, view.match[at], dx, dy)) continue;
      const std::int64_t size = view.piece_size[at];
      const bool joins = size >= (view.replaces_pieces ? nearly_full : view.copy_cap);
      search.Offer(static_cast<std::uint32_t>(texel), joins ? price::join : 0);
    }
    search.Offer(pick, 0);
    if (search.best_cost == no_price)
      search.best = allowed_texel(view, pixel, search.forbidden, view.key, x, y);
    *next = search.best;
  }
}

template <int radius>
std::int64_t OnePatchCostOf(const KernelView& view, std::uint32_t pixel, std::uint32_t texel) {
  Patch<radius> patch;
  LoadPatch<radius>(view, pixel, patch);
  return PatchCost<radius>(patch, view.exemplars->words.data() + texel, view.exemplars->stride,
                           no_price);
}

std::int64_t OneGuidesCost(const KernelView& view, std::uint32_t pixel, std::uint32_t texel) {
  Search<patch_radius> search;
  search.Begin(view, pixel);
  return search.GuideCost(texel, view.texels->at(texel).guides());
}

template <int radius>
int BestMoveOf(const KernelView& view, const std::vector<PieceSample>& samples,
               const std::vector<std::uint32_t>& candidates) {
  std::vector<Search<radius>> searches(samples.size());
  for (std::size_t s = 0; s < samples.size(); ++s) searches[s].Begin(view, samples[s].pixel);
  const Plane& exemplars = *view.exemplars;
  int best = -1;
  std::int64_t best_cost = no_price;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    const Plane::Place position = exemplars.position(candidates[c]);
    const Plane::Part& part = exemplars.parts[static_cast<std::size_t>(position.part)];
    std::int64_t cost = 0;
    for (std::size_t s = 0; s < samples.size() && cost < best_cost; ++s) {
      const int x = position.x + samples[s].dx;
      const int y = position.y + samples[s].dy;
      const Search<radius>& search = searches[s];
      const std::uint32_t texel = x < 0 || y < 0 || x >= part.width || y >= part.height
                                      ? exemplars.nowhere()
                                      : exemplars.index(position.part, x, y);
      if (class_of(exemplars.words[texel]) != search.label_class) {
        cost += price::misfit;
        continue;
      }
      const TexelRecords::Record record = view.texels->at(texel);
      const std::int64_t others = record.uses();
      cost += guide_cost(view, search.requested, record.guides(), search.slack,
                         lacking_of(exemplars, texel, search.label_class)) +
              search.AroundCost(record.around()) +
              (others * (others + 1) / 2 * view.reuse_q4[search.label_class] >> 4) +
              view.bin_cost[search.label_class * 64 + record.bin()];
      cost += PatchCost<radius>(search.patch, exemplars.words.data() + texel, exemplars.stride,
                                no_price);
    }
    if (cost < best_cost) {
      best_cost = cost;
      best = static_cast<int>(c);
    }
  }
  return best;
}

// f(std::integral_constant<int, radius>()) for the view's radius.
template <class F>
auto WithRadius(const KernelView& view, F&& f) {
  switch (view.radius) {
    case 1:
      return f(std::integral_constant<int, 1>());
    case 2:
      return f(std::integral_constant<int, 2>());
    case 4:
      return f(std::integral_constant<int, 4>());
    case 5:
      return f(std::integral_constant<int, 5>());
    default:
      return f(std::integral_constant<int, 3>());
  }
}

void ImproveRow(const KernelView& view, int x0, int x1, int y, std::uint32_t* next) {
  WithRadius(view,
             [&](auto radius) { ImproveRowOf<decltype(radius)::value>(view, x0, x1, y, next); });
}
std::int64_t OnePatchCost(const KernelView& view, std::uint32_t pixel, std::uint32_t texel) {
  return WithRadius(view, [&](auto radius) {
    return OnePatchCostOf<decltype(radius)::value>(view, pixel, texel);
  });
}
int BestMove(const KernelView& view, const std::vector<PieceSample>& samples,
             const std::vector<std::uint32_t>& candidates) {
  return WithRadius(view, [&](auto radius) {
    return BestMoveOf<decltype(radius)::value>(view, samples, candidates);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace belvedere::synth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace belvedere::synth {

HWY_EXPORT(ImproveRow);
HWY_EXPORT(OnePatchCost);
HWY_EXPORT(OneGuidesCost);
HWY_EXPORT(BestMove);

void improve_row(const KernelView& view, int x0, int x1, int y, std::uint32_t* next) {
  HWY_DYNAMIC_DISPATCH(ImproveRow)(view, x0, x1, y, next);
}

std::int64_t patch_cost(const KernelView& view, std::uint32_t pixel, std::uint32_t texel) {
  return HWY_DYNAMIC_DISPATCH(OnePatchCost)(view, pixel, texel);
}

std::int64_t guides_cost(const KernelView& view, std::uint32_t pixel, std::uint32_t texel) {
  return HWY_DYNAMIC_DISPATCH(OneGuidesCost)(view, pixel, texel);
}

int best_move(const KernelView& view, const std::vector<PieceSample>& samples,
              const std::vector<std::uint32_t>& candidates) {
  return HWY_DYNAMIC_DISPATCH(BestMove)(view, samples, candidates);
}

std::vector<std::string> vector_targets() {
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    names.emplace_back(hwy::TargetName(target));
  return names;
}

void use_vector_target(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);
  std::int64_t chosen = 0;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
    if (name == hwy::TargetName(target)) chosen = target;
  if (!name.empty() && chosen == 0)
    throw Error(ErrorKind::limit, "vector instructions", name, "one that this processor has");
  hwy::SetSupportedTargetsForTest(chosen);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace belvedere::synth
#endif
