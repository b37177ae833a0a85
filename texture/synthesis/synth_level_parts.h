#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

#include "base/parallel.h"
#include "texture/synthesis/synth_bins.h"
#include "texture/synthesis/synth_state.h"

// Shared by the parts of a level; internal.
namespace belvedere::synth {

using BinCounts = std::vector<std::int32_t>;

// Sum of f(i, counts) over 0 <= i < count, each f adding to the counts it is given. Integers, so
// the order of ranges does not matter.
template <class F>
BinCounts sum_bins(int count, std::size_t size, F&& f) {
  BinCounts total(size, 0);
  std::mutex adding;
  parallel_ranges(count, 16, [&](int begin, int end) {
    BinCounts sums(size, 0);
    for (int i = begin; i != end; ++i) f(i, sums);
    const std::scoped_lock lock(adding);
    std::transform(total.begin(), total.end(), sums.begin(), total.begin(), std::plus<>());
  });
  return total;
}

inline std::size_t bin_of(const LevelState& state, std::uint32_t label_class, std::uint32_t texel) {
  return static_cast<std::size_t>(label_class) * bins_per_class + state.texels.at(texel).bin();
}

// Number of pixels that copy it: others may move to or from the same texel at the same time.
inline void add_use(LevelState& state, std::uint32_t texel, std::uint32_t by) {
  std::atomic_ref<std::uint32_t>(state.texels.uses(texel)).fetch_add(by, std::memory_order_relaxed);
}

inline void move_pixel(LevelState& state, std::uint32_t pixel, std::uint32_t texel,
                       BinCounts& bins) {
  const std::uint32_t before = state.match[pixel];
  if (before == texel) return;
  std::uint32_t& word = state.target.words[pixel];
  const std::uint32_t label_class = class_of(word);
  add_use(state, before, ~std::uint32_t{0});  // minus 1
  add_use(state, texel, 1);
  --bins[bin_of(state, label_class, before)];
  ++bins[bin_of(state, label_class, texel)];
  state.match[pixel] = texel;
  word = (state.exemplars.words[texel] & 0xffffffU) | label_class << 24;
}

inline void update_bin_cost(LevelState& state) {
  state.bin_cost = steer_bins(state.bins_actual, state.bins_expected,
                              static_cast<std::int32_t>(price::bin), state.bin_cost_kept);
}

inline void add_to(BinCounts& sums, const BinCounts& change) {
  std::transform(sums.begin(), sums.end(), change.begin(), sums.begin(), std::plus<>());
}

inline void find_pieces(LevelState& state) {
  state.pieces.find(state.target, state.exemplars, state.match,
                    state.fixed.empty() ? nullptr : state.fixed.data());
}

// Rows of a sub-pass that make a task worthwhile: on coarse levels fewer tasks than rows, so that
// threads do not mostly wait.
inline int rows_per_task(int width) { return std::max(1, 8192 / std::max(1, width)); }

// Moves every second pixel of every second row to its result in state.next.
void commit_next(LevelState& state, int odd_x, int odd_y);

}  // namespace belvedere::synth
