#include "texture/synthesis/synth_level.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <mutex>

#include "base/parallel.h"
#include "base/random.h"
#include "texture/synthesis/synth_lists.h"

// Shared by the parts of a level; internal.

namespace belvedere::synth {
namespace {

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

struct Move {
  std::uint32_t pixel = 0;
  std::uint32_t texel = 0;
};

struct Member {
  std::uint32_t piece = 0;  // its first pixel
  int x = 0;
  int y = 0;
};

// The new position of each group of pixels of one piece and cell.
void find_moves(const LevelState& state, const KernelView& view, const Member* members, int count,
                std::uint64_t key, std::vector<Move>& moves) {
  constexpr int picks = 24;
  constexpr int far_enough = 8;  // texels from where the group copies now
  constexpr int target_samples = 12;
  const Plane& exemplars = state.exemplars;
  const Member& centre = members[count / 2];
  const std::uint32_t pixel = state.target.index(0, centre.x, centre.y);
  const Plane::Place now = exemplars.position(state.match[pixel]);
  const Slack slack = make_slack(view, pixel);
  std::vector<std::uint32_t> candidates;
  for (int i = 0; i < picks; ++i) {
    const std::uint64_t draw = random_bits(key, static_cast<std::int64_t>(pixel), i);
    const std::uint32_t texel = draw_texel(view, pixel, draw, 0, 0, slack);
    const Plane::Place position = exemplars.position(texel);
    if (position.part == now.part && std::abs(position.x - now.x) < far_enough &&
        std::abs(position.y - now.y) < far_enough)
      continue;
    candidates.push_back(texel);
  }
  const int step = std::max(1, count / target_samples);
  std::vector<PieceSample> samples;
  for (int i = step / 2; i < count; i += step) {
    samples.push_back({state.target.index(0, members[i].x, members[i].y), members[i].x - centre.x,
                       members[i].y - centre.y});
  }
  const int best = best_move(view, samples, candidates);
  if (best < 0) return;
  const Plane::Place to = exemplars.position(candidates[static_cast<std::size_t>(best)]);
  const Plane::Part& part = exemplars.parts[static_cast<std::size_t>(to.part)];
  for (int i = 0; i < count; ++i) {
    const int x = to.x + members[i].x - centre.x;
    const int y = to.y + members[i].y - centre.y;
    if (x < 0 || y < 0 || x >= part.width || y >= part.height) continue;
    const std::uint32_t member = state.target.index(0, members[i].x, members[i].y);
    const std::uint32_t texel = exemplars.index(to.part, x, y);
    if (class_of(exemplars.words[texel]) == class_of(state.target.words[member]))
      moves.push_back({member, texel});
  }
}

}  // namespace

bool replace_pieces(LevelState& state, int pass, int round) {
  if (static_cast<std::int64_t>(state.pieces.largest()) <= state.settings.copy_cap) return false;
  const int number = pass * 7 + round;
  const std::uint64_t cell_key = key_for(state.settings, Purpose::cells, number);
  const std::uint64_t move_key = key_for(state.settings, Purpose::moves, number);
  const Plane::Part& part = state.target.parts[0];
  update_bin_cost(state);
  const KernelView view = state.view(pass);

  // The pixels of a cell are in the 3 × 3 squares around the square that contains its point: one
  // row of squares per task.
  const int across = (part.width + cell_side - 1) / cell_side;
  const int down = (part.height + cell_side - 1) / cell_side;
  std::vector<std::vector<Move>> moves(static_cast<std::size_t>(down + 2));
  parallel_rows(down + 2, [&](int i) {
    const int cell_y = i - 1;
    std::vector<std::vector<Member>> cells(static_cast<std::size_t>(across + 2));
    for (int y = std::max(0, (cell_y - 1) * cell_side);
         y < std::min(part.height, (cell_y + 2) * cell_side); ++y) {
      for (int x = 0; x < part.width; ++x) {
        const std::uint32_t at = state.target.index(0, x, y);
        if (state.pieces.size()[at] <= state.settings.copy_cap || view.is_fixed(at)) continue;
        const Cell cell = cell_around(x, y, cell_key);
        if (cell.y != cell_y || cell.odd != (number & 1)) continue;
        const int column = cell.x + 1;
        cells[static_cast<std::size_t>(column)].push_back({state.pieces.first_pixel(at), x, y});
      }
    }
    for (std::vector<Member>& members : cells) {
      std::stable_sort(members.begin(), members.end(),
                       [](const Member& a, const Member& b) { return a.piece < b.piece; });
      for (std::size_t from = 0; from < members.size();) {
        std::size_t to = from;
        while (to < members.size() && members[to].piece == members[from].piece) ++to;
        find_moves(state, view, &members[from], static_cast<int>(to - from), move_key,
                   moves[static_cast<std::size_t>(i)]);
        from = to;
      }
    }
  });
  add_to(state.bins_actual,
         sum_bins(down + 2, state.bins_actual.size(), [&](int i, BinCounts& bins) {
           for (const Move& move : moves[static_cast<std::size_t>(i)])
             move_pixel(state, move.pixel, move.texel, bins);
         }));
  find_pieces(state);
  return true;
}

namespace {

// Gives each pixel that `chosen` returns a texel by which it belongs to no neighbour's piece: the
// cheapest of some picks. With `widen` >= 0 from wider windows, and only texels that may be used
// once more; if none is found the pixel stays unchanged.
template <class F>
void isolate(LevelState& state, int number, F&& chosen, int widen = -1) {
  static constexpr std::array<std::array<int, 2>, 4> parities{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}};
  constexpr int picks = 16;
  const Plane::Part& part = state.target.parts[0];
  const std::size_t across = static_cast<std::size_t>((part.width + 1) / 2);
  const std::uint64_t key = key_for(state.settings, Purpose::alone, number);
  // Direct neighbours have other parities, so their state does not change while a pixel moves.
  for (const auto& [odd_x, odd_y] : parities) {
    update_bin_cost(state);
    const KernelView view = state.view(0);
    parallel_rows((part.height - odd_y + 1) / 2, [&, ox = odd_x, oy = odd_y](int i) {
      const int y = 2 * i + oy;
      std::uint32_t* next = state.next.data() + static_cast<std::size_t>(i) * across;
      std::vector<std::uint32_t> candidates;
      for (int x = ox; x < part.width; x += 2, ++next) {
        const std::uint32_t at = state.target.index(0, x, y);
        *next = state.match[at];
        if (class_of(state.target.words[at]) == no_class || view.is_fixed(at) ||
            !chosen(view, at, x, y))
          continue;
        const Forbidden forbidden = forbidden_texels(view, at, true);
        const Slack slack = make_slack(view, at);
        candidates.clear();
        const std::uint32_t max = view.max_uses[class_of(state.target.words[at])];
        for (int k = 0; k < picks; ++k) {
          const PickRun run =
              begin_draw(view, at, key + static_cast<std::uint64_t>(k), x, y, std::max(0, widen));
          const std::uint32_t texel = finish_draw(view, at, run, slack);
          if (!forbidden.has(texel) && (widen < 0 || view.texels->at(texel).uses() < max))
            candidates.push_back(texel);
        }
        const int best = best_move(view, {PieceSample{at, 0, 0}}, candidates);
        if (best < 0 && widen >= 0) continue;
        *next = best >= 0 ? candidates[static_cast<std::size_t>(best)]
                          : allowed_texel(view, at, forbidden, key, x, y);
      }
    });
    commit_next(state, odd_x, odd_y);
  }
}

}  // namespace

namespace {

// One round in which the pixels that share an overused texel each take another, with the
// probability that leaves as many as allowed. Returns whether there were any.
bool spread_uses(LevelState& state, int round, int widen) {
  const std::uint64_t key = key_for(state.settings, Purpose::alone, 100 + round);
  std::atomic<bool> any = false;
  const auto one_too_many = [&](const KernelView& view, std::uint32_t at, int x, int y) {
    const std::uint32_t uses = view.texels->at(view.match[at]).uses();
    const std::uint32_t max = view.max_uses[class_of(view.target->words[at])];
    if (uses <= max) return false;
    any.store(true, std::memory_order_relaxed);
    return random_index(uses, key, x, y) >= max;
  };
  isolate(state, 200 + round, one_too_many, widen);
  return any.load();
}

// Pixels whose texel is outside their own window of the guide that orders the lists.
std::vector<std::uint32_t> beyond_window(const LevelState& state) {
  std::vector<std::uint32_t> pixels;
  const KernelView view = state.view(0);
  if (!view.lists->keys().sorted) return pixels;
  state.target.for_each([&](std::uint32_t at) {
    const std::uint32_t label_class = class_of(state.target.words[at]);
    if (label_class == no_class ||
        !state.exemplars.knows(state.exemplars.part_of(state.match[at]), 0))
      return;
    const std::uint8_t* requested = state.target.guides_at(at);
    const int off = std::abs(requested[0] - view.texels->at(state.match[at]).guides()[0]);
    if (off > view.lists->window(label_class, requested).slack + 1) pixels.push_back(at);
  });
  return pixels;
}

// No texel used too often, no piece over the cap, none across a silhouette; each step may slightly
// violate the one before.
void limit_pieces(LevelState& state) {
  constexpr int max_rounds = 12;
  const std::int64_t cap = state.settings.copy_cap;
  const int first = state.settings.passes + state.settings.replacing_passes;
  for (int round = 0; round < max_rounds && spread_uses(state, round, -1); ++round)
    find_pieces(state);
  for (int round = 0; round < max_rounds && replace_pieces(state, first, round); ++round) {
  }
  if (!state.links.empty() || state.source->has_cuts) {
    isolate(state, 0, [](const KernelView& view, std::uint32_t at, int, int) {
      const bool at_silhouette =
          view.has_cuts || (view.links != nullptr && (view.links[at] & link::all) != link::all);
      return at_silhouette && forbidden_texels(view, at).has(view.match[at]);
    });
    find_pieces(state);
  }
  if (static_cast<std::int64_t>(state.pieces.largest()) <= cap) return;
  // The last resort: lines of single pixels divide the rest into squares under the cap.
  const int side = static_cast<int>(std::sqrt(static_cast<double>(cap))) + 1;
  isolate(state, 1, [&](const KernelView& view, std::uint32_t at, int x, int y) {
    return view.piece_size[at] > cap && (x % side == 0 || y % side == 0);
  });
  find_pieces(state);
  if (state.fixed.empty() || static_cast<std::int64_t>(state.pieces.largest()) <= cap) return;
  // Fixed pixels cannot be cut; they were under the cap where they were made, so the pixels added
  // to them are cut off.
  isolate(state, 2, [&](const KernelView& view, std::uint32_t at, int, int) {
    const std::uint32_t down = static_cast<std::uint32_t>(view.target->stride);
    return view.piece_size[at] > cap && (view.is_fixed(at - 1) || view.is_fixed(at + 1) ||
                                         view.is_fixed(at - down) || view.is_fixed(at + down));
  });
  find_pieces(state);
}

}  // namespace

void finish_pieces(LevelState& state) {
  limit_pieces(state);
  // Moving pieces as a whole may have brought texels over their limit again, and where few texels
  // meet a request, windows cannot satisfy it at all: they are widened until they do. A pixel that
  // moves here is a piece of its own, so pieces and silhouettes stay unchanged.
  constexpr int max_rounds = 24;
  constexpr int rounds_each = 2;  // before windows widen
  bool widened = false;
  for (int round = 0; round < max_rounds && spread_uses(state, 300 + round, round / rounds_each);
       ++round)
    widened = round >= rounds_each;
  if (widened) state.widened = beyond_window(state);
  find_pieces(state);
}

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
