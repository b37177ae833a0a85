#include "texture/synthesis/synth_level.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "base/parallel.h"
#include "texture/synthesis/synth_level_parts.h"
#include "texture/synthesis/synth_replace.h"

namespace belvedere::synth {

void start_from_picks(LevelState& state) {
  const KernelView view = state.view(0);
  const std::uint64_t key = key_for(state.settings, Purpose::start);
  const Plane::Part& part = state.target.parts[0];
  parallel_rows(part.height, [&](int y) {
    for (int x = 0; x < part.width; ++x) {
      const std::uint32_t at = state.target.index(0, x, y);
      if (class_of(state.target.words[at]) != no_class)
        state.match[at] = draw_texel(view, at, key, x, y, make_slack(view, at));
    }
  });
  count_matches(state);
}

void start_from_coarser(LevelState& state, const Plane& coarse_exemplars,
                        const Plane& coarse_target,
                        const std::vector<std::uint32_t>& coarse_match) {
  static constexpr std::array<std::array<int, 2>, 9> parents{
      {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
  const KernelView view = state.view(0);
  const std::uint64_t key = key_for(state.settings, Purpose::start);
  const Plane::Part& part = state.target.parts[0];
  parallel_rows(part.height, [&](int y) {
    for (int x = 0; x < part.width; ++x) {
      const std::uint32_t at = state.target.index(0, x, y);
      const std::uint32_t label_class = class_of(state.target.words[at]);
      if (label_class == no_class) continue;
      if (view.is_fixed(at)) {
        state.match[at] = state.fixed[at];
        continue;
      }
      bool found = false;
      for (std::size_t p = 0; p < parents.size() && !found; ++p) {
        // Padding around the coarser target has no match, so parents beyond its border are skipped
        // automatically.
        const std::uint32_t parent =
            coarse_match[coarse_target.index(0, x / 2 + parents[p][0], y / 2 + parents[p][1])];
        if (parent == coarse_exemplars.nowhere()) continue;
        const Plane::Place position = coarse_exemplars.position(parent);
        const int source_x = 2 * (position.x - parents[p][0]) + (x & 1);
        const int source_y = 2 * (position.y - parents[p][1]) + (y & 1);
        const Plane::Part& source = state.exemplars.parts[static_cast<std::size_t>(position.part)];
        if (source_x < 0 || source_y < 0 || source_x >= source.width || source_y >= source.height)
          continue;
        const std::uint32_t texel = state.exemplars.index(position.part, source_x, source_y);
        if (class_of(state.exemplars.words[texel]) != label_class) continue;
        state.match[at] = texel;
        found = true;
      }
      if (!found) state.match[at] = draw_texel(view, at, key, x, y, make_slack(view, at));
    }
  });
  count_matches(state);
}

void recount(LevelState& state) {
  state.texels.forget_uses();
  count_matches(state);
}

void forget_uses_of(LevelState& state) {
  const Plane::Part& part = state.target.parts[0];
  parallel_rows(part.height, [&](int y) {
    const std::uint32_t row = state.target.index(0, 0, y);
    for (std::uint32_t at = row; at < row + static_cast<std::uint32_t>(part.width); ++at)
      std::atomic_ref<std::uint32_t>(state.texels.uses(state.match[at]))
          .store(0, std::memory_order_relaxed);
  });
}

void count_matches(LevelState& state) {
  const Plane::Part& part = state.target.parts[0];
  const KernelView view = state.view(0);
  const std::uint64_t key = key_for(state.settings, Purpose::expectation);
  state.bins_actual =
      sum_bins(part.height, state.bins_actual.size(), [&](int y, BinCounts& counts) {
        for (int x = 0; x < part.width; ++x) {
          const std::uint32_t at = state.target.index(0, x, y);
          std::uint32_t& word = state.target.words[at];
          const std::uint32_t label_class = class_of(word);
          if (label_class == no_class) continue;
          const std::uint32_t texel = state.match[at];
          add_use(state, texel, 1);
          ++counts[bin_of(state, label_class, texel)];
          word = (state.exemplars.words[texel] & 0xffffffU) | label_class << 24;
        }
      });
  state.bins_expected =
      sum_bins(part.height, state.bins_expected.size(), [&](int y, BinCounts& counts) {
        for (int x = 0; x < part.width; ++x) {
          const std::uint32_t at = state.target.index(0, x, y);
          const std::uint32_t label_class = class_of(state.target.words[at]);
          if (label_class == no_class) continue;
          ++counts[bin_of(state, label_class,
                          draw_texel(view, at, key, x, y, make_slack(view, at)))];
        }
      });
}

void sub_pass(LevelState& state, int pass, int odd_x, int odd_y) {
  const Plane::Part& part = state.target.parts[0];
  const int rows = (part.height - odd_y + 1) / 2;
  const std::size_t across = static_cast<std::size_t>((part.width + 1) / 2);
  update_bin_cost(state);
  const KernelView view = state.view(pass);
  const auto improve_part = [&](int x0, int x1, int i) {
    std::uint32_t* next = state.next.data() + static_cast<std::size_t>(i) * across + x0 / 2;
    improve_row(view, x0 + odd_x, x1, 2 * i + odd_y, next);
  };
  if (state.settings.tile > 0) {
    parallel_tiles(part.width, part.height, state.settings.tile, [&](const PixelRect& tile) {
      for (int i = tile.y0 / 2; i < std::min(rows, (tile.y1 + 1) / 2); ++i)
        improve_part(tile.x0, tile.x1, i);
    });
  } else {
    parallel_ranges(rows, rows_per_task(part.width), [&](int begin, int end) {
      for (int i = begin; i != end; ++i) improve_part(0, part.width, i);
    });
  }
  commit_next(state, odd_x, odd_y);
}

void improve(LevelState& state, Progress& progress) {
  static constexpr std::array<std::array<int, 2>, 4> parities{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}};
  const LevelSettings& settings = state.settings;
  const int passes = settings.passes + settings.replacing_passes;
  for (int pass = 0; pass < passes; ++pass) {
    find_pieces(state);
    if (settings.replacing_passes > 0 && pass >= settings.passes - 1) {
      for (int round = 0; round < 2 && replace_pieces(state, pass, round); ++round) {
      }
    }
    for (const auto& [odd_x, odd_y] : parities) sub_pass(state, pass, odd_x, odd_y);
    progress.advance(1);
  }
  if (settings.level == 0) {
    find_pieces(state);
    finish_pieces(state);
  }
}

}  // namespace belvedere::synth
