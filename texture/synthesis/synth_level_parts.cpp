#include "texture/synthesis/synth_level_parts.h"

#include <cstddef>
#include <cstdint>

namespace belvedere::synth {

void commit_next(LevelState& state, int odd_x, int odd_y) {
  const Plane::Part& part = state.target.parts[0];
  const int rows = (part.height - odd_y + 1) / 2;
  const std::size_t across = static_cast<std::size_t>((part.width + 1) / 2);
  add_to(state.bins_actual, sum_bins(rows, state.bins_actual.size(), [&](int i, BinCounts& bins) {
           const std::uint32_t* found = state.next.data() + static_cast<std::size_t>(i) * across;
           for (int x = odd_x; x < part.width; x += 2, ++found)
             move_pixel(state, state.target.index(0, x, 2 * i + odd_y), *found, bins);
         }));
}

}  // namespace belvedere::synth
