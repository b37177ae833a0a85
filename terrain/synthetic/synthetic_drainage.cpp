#include "terrain/synthetic/synthetic_drainage.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "base/random.h"
#include "base/rising_queue.h"

namespace belvedere::synthetic {
namespace {

// A flood that goes from cell to cell jumps about the map and waits for memory at every step. What it ends in can be said without it:
// every cell runs down to the bottom of its basin; a basin fills up to the lowest of the passes on its best way to an outlet (a minimum
// spanning tree of basins: Cordonnier, Bovy & Braun 2019); and the flood takes cells by their filled altitude, so that sorting gives its
// order.

constexpr int neighbour_x[8] = {-1, 0, 1, -1, 1, -1, 0, 1};
constexpr int neighbour_y[8] = {-1, -1, -1, 0, 0, 1, 1, 1};
constexpr bool is_diagonal[8] = {true, false, true, false, false, true, false, true};

constexpr std::size_t ahead = 16;  // cells
constexpr std::int32_t is_outlet = -1;
constexpr std::int32_t is_flat = -2;  // no lower neighbour

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// f(k, j) for the neighbours j of a cell, by rising index.
template <class F>
void for_neighbours(const Grid<float>& grid, int x, int y, F&& f) {
  const int width = grid.width();
  const auto i = static_cast<std::int32_t>(grid.index(x, y));
  const bool inside = x > 0 && y > 0 && x + 1 < width && y + 1 < grid.height();
  for (int k = 0; k < 8; ++k)
    if (inside || grid.contains(x + neighbour_x[k], y + neighbour_y[k])) f(k, i + neighbour_y[k] * width + neighbour_x[k]);
}

// A lower neighbour of each cell, its lowest; bottoms of basins and outlets have themselves. Of cells as high as each other, those with a
// lower index count as lower, so that a flat has one bottom or leads on.
std::vector<std::int32_t> find_descents(const Grid<float>& altitude_m, const std::vector<std::int32_t>& outlets) {
  std::vector<std::int32_t> descent(altitude_m.size());
  const int width = altitude_m.width();
  parallel_rows(altitude_m.height(), [&](int y) {
    const auto lowest = [&](int x) {
      auto to = static_cast<std::int32_t>(altitude_m.index(x, y));
      float z = altitude_m[at(to)];
      for_neighbours(altitude_m, x, y, [&](int k, std::int32_t j) {
        const float there = altitude_m[at(j)];
        const bool takes = k < 4 ? there <= z : there < z;
        to = takes ? j : to;
        z = takes ? there : z;
      });
      descent[altitude_m.index(x, y)] = to;
    };
    if (y == 0 || y + 1 == altitude_m.height()) {
      for (int x = 0; x < width; ++x) lowest(x);
      return;
    }
    lowest(0);
    if (width > 1) lowest(width - 1);
    // The same without questions, several cells at a time.
    const float* const above = altitude_m.row(y - 1);
    const float* const here = altitude_m.row(y);
    const float* const below = altitude_m.row(y + 1);
    std::int32_t* const out = &descent[altitude_m.index(0, y)];
    const std::int32_t first = y * width;
    for (int x = 1; x + 1 < width; ++x) {
      float z = here[x];
      std::int32_t step = 0;
      const auto no_higher = [&](float there, std::int32_t way) {
        step = there <= z ? way : step;
        z = there <= z ? there : z;
      };
      const auto lower = [&](float there, std::int32_t way) {
        step = there < z ? way : step;
        z = there < z ? there : z;
      };
      no_higher(above[x - 1], -width - 1);
      no_higher(above[x], -width);
      no_higher(above[x + 1], -width + 1);
      no_higher(here[x - 1], -1);
      lower(here[x + 1], 1);
      lower(below[x - 1], width - 1);
      lower(below[x], width);
      lower(below[x + 1], width + 1);
      out[x] = first + x + step;
    }
  });
  for (const std::int32_t i : outlets) descent[at(i)] = i;
  return descent;
}

// Basin 0 is all that runs to an outlet, the others end in pits.
struct Basins {
  std::vector<std::int32_t> of_cell;
  int count = 1;
};

Basins find_basins(const std::vector<std::int32_t>& descent, const std::vector<std::int32_t>& outlets) {
  constexpr std::int32_t unknown = -1;
  Basins basins;
  basins.of_cell.assign(descent.size(), unknown);
  for (const std::int32_t i : outlets) basins.of_cell[at(i)] = 0;
  std::vector<std::int32_t> way;
  for (std::size_t start = 0; start < descent.size(); ++start) {
    auto i = static_cast<std::int32_t>(start);
    for (; basins.of_cell[at(i)] == unknown && descent[at(i)] != i; i = descent[at(i)]) way.push_back(i);
    if (basins.of_cell[at(i)] == unknown) basins.of_cell[at(i)] = basins.count++;
    for (const std::int32_t cell : way) basins.of_cell[at(cell)] = basins.of_cell[at(i)];
    way.clear();
  }
  return basins;
}

// Where water runs over from one basin into another.
struct Pass {
  float level_m;
  std::int32_t one;
  std::int32_t other;
};

std::vector<Pass> find_passes(const Grid<float>& altitude_m, const Basins& basins) {
  std::vector<Pass> passes;
  const int width = altitude_m.width();
  for (int y = 0; y < altitude_m.height(); ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = altitude_m.index(x, y);
      const auto look = [&](std::size_t j) {
        if (basins.of_cell[i] != basins.of_cell[j])
          passes.push_back({std::max(altitude_m[i], altitude_m[j]), basins.of_cell[i], basins.of_cell[j]});
      };
      if (x + 1 < width) look(i + 1);
      if (y + 1 == altitude_m.height()) continue;
      const std::size_t under = i + static_cast<std::size_t>(width);
      if (x > 0) look(under - 1);
      look(under);
      if (x + 1 < width) look(under + 1);
    }
  }
  return passes;
}

// The level up to which each basin fills: passes are opened from the lowest on, and what comes to be joined to the outlets by one runs over
// at its level (Kruskal 1956).
std::vector<float> find_spill_levels(std::vector<Pass> passes, int basins) {
  std::sort(passes.begin(), passes.end(), [](const Pass& a, const Pass& b) { return a.level_m < b.level_m; });
  const auto count = static_cast<std::size_t>(basins);
  std::vector<float> level_m(count, -std::numeric_limits<float>::infinity());
  std::vector<std::int32_t> parent(count);
  std::iota(parent.begin(), parent.end(), 0);
  // Rings of the basins joined so far, by the next one.
  std::vector<std::int32_t> next = parent;
  std::vector<std::int32_t> size(count, 1);
  const auto joined = [&](std::int32_t b) {
    while (parent[at(b)] != b) b = parent[at(b)] = parent[at(parent[at(b)])];
    return b;
  };
  for (const Pass& pass : passes) {
    std::int32_t a = joined(pass.one);
    std::int32_t b = joined(pass.other);
    if (a == b) continue;
    if (a != 0 && (b == 0 || size[at(a)] < size[at(b)])) std::swap(a, b);
    if (a == 0) {
      std::int32_t member = b;
      do {
        level_m[at(member)] = pass.level_m;
        member = next[at(member)];
      } while (member != b);
    } else {
      std::swap(next[at(a)], next[at(b)]);
      size[at(a)] += size[at(b)];
    }
    parent[at(b)] = a;
  }
  return level_m;
}

// Cells by altitude, of equal ones by index: a radix sort by three parts of the key.
std::vector<std::int32_t> sort_cells(const Grid<float>& altitude_m) {
  constexpr int digits = 3;
  constexpr int bits = 11;
  constexpr std::size_t values = std::size_t{1} << bits;
  const auto digit_of = [](std::uint64_t key, int digit) { return static_cast<std::size_t>(key >> (32 + bits * digit)) & (values - 1); };
  std::array<std::array<std::uint32_t, values>, digits> places{};
  std::vector<std::uint64_t> keys(altitude_m.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    keys[i] = rising_key(altitude_m[i], static_cast<std::uint32_t>(i));
    for (int digit = 0; digit < digits; ++digit) ++places[static_cast<std::size_t>(digit)][digit_of(keys[i], digit)];
  }
  std::vector<std::uint64_t> sorted(keys.size());
  for (int digit = 0; digit < digits; ++digit) {
    auto& place = places[static_cast<std::size_t>(digit)];
    std::exclusive_scan(place.begin(), place.end(), place.begin(), 0U);
    for (const std::uint64_t key : keys) sorted[place[digit_of(key, digit)]++] = key;
    keys.swap(sorted);
  }
  std::vector<std::int32_t> order(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) order[i] = static_cast<std::int32_t>(keys[i] & 0xffffffffU);
  return order;
}

// Receivers by steepest descent on filled ground; is_flat where nothing is lower.
std::vector<std::int32_t> find_receivers(const Grid<float>& filled_m, const std::vector<std::int32_t>& outlets, std::uint64_t seed) {
  std::vector<std::int32_t> receivers(filled_m.size());
  const int width = filled_m.width();
  parallel_ranges(filled_m.height(), 8, [&](int begin, int end) {
    std::vector<float> diagonal(static_cast<std::size_t>(width));  // how much of a diagonal drop counts
    for (int y = begin; y != end; ++y) {
      const auto first = static_cast<std::int32_t>(filled_m.index(0, y));
      for (int x = 0; x < width; ++x) diagonal[at(x)] = 1.F / (2.F - static_cast<float>(random_uniform(seed, x, y)));
      const auto steepest_way = [&](int x) {
        const float here = filled_m(x, y);
        std::int32_t receiver = is_flat;
        float steepest = 0.F;
        for_neighbours(filled_m, x, y, [&](int k, std::int32_t j) {
          const float drop = (here - filled_m[at(j)]) * (is_diagonal[k] ? diagonal[at(x)] : 1.F);
          receiver = drop > steepest ? j : receiver;
          steepest = drop > steepest ? drop : steepest;
        });
        receivers[at(first + x)] = receiver;
      };
      if (y == 0 || y + 1 == filled_m.height()) {
        for (int x = 0; x < width; ++x) steepest_way(x);
        continue;
      }
      steepest_way(0);
      if (width > 1) steepest_way(width - 1);
      // The same without questions, several cells at a time.
      const float* const above = filled_m.row(y - 1);
      const float* const here = filled_m.row(y);
      const float* const below = filled_m.row(y + 1);
      const float* const share = diagonal.data();
      std::int32_t* const out = &receivers[at(first)];
      for (int x = 1; x + 1 < width; ++x) {
        std::int32_t step = 0;
        float steepest = 0.F;
        const auto steeper = [&](float drop, std::int32_t way) {
          step = drop > steepest ? way : step;
          steepest = drop > steepest ? drop : steepest;
        };
        steeper((here[x] - above[x - 1]) * share[x], -width - 1);
        steeper(here[x] - above[x], -width);
        steeper((here[x] - above[x + 1]) * share[x], -width + 1);
        steeper(here[x] - here[x - 1], -1);
        steeper(here[x] - here[x + 1], 1);
        steeper((here[x] - below[x - 1]) * share[x], width - 1);
        steeper(here[x] - below[x], width);
        steeper((here[x] - below[x + 1]) * share[x], width + 1);
        out[x] = steepest > 0.F ? first + x + step : is_flat;
      }
    }
  });
  for (const std::int32_t i : outlets) receivers[at(i)] = is_outlet;
  return receivers;
}

// Cells first … last of the order are as high as each other. The water reaches them from lower cells and outlets, and from there goes on
// over the flat: always to the lowest index beside it. Each flat cell takes for its receiver the one from which it was reached.
void order_flat(std::vector<std::int32_t>& order, std::size_t first, std::size_t last, const Grid<float>& filled_m,
                std::vector<std::int32_t>& receivers) {
  std::vector<std::int32_t> front;
  for (std::size_t k = first; k < last; ++k)
    if (receivers[at(order[k])] != is_flat) front.push_back(order[k]);
  std::make_heap(front.begin(), front.end(), std::greater<>());
  const float level = filled_m[at(order[first])];
  for (std::size_t k = first; k < last; ++k) {
    std::pop_heap(front.begin(), front.end(), std::greater<>());
    const std::int32_t i = front.back();
    front.pop_back();
    order[k] = i;
    for_neighbours(filled_m, i % filled_m.width(), i / filled_m.width(), [&](int, std::int32_t j) {
      if (receivers[at(j)] != is_flat || filled_m[at(j)] != level) return;
      receivers[at(j)] = i;
      front.push_back(j);
      std::push_heap(front.begin(), front.end(), std::greater<>());
    });
  }
}

}  // namespace

void fill_to_spill_level(Grid<float>& altitude_m, const std::vector<std::int32_t>& outlets) {
  const Basins basins = find_basins(find_descents(altitude_m, outlets), outlets);
  if (basins.count == 1) return;
  const std::vector<float> level_m = find_spill_levels(find_passes(altitude_m, basins), basins.count);
  parallel_ranges(altitude_m.size(), std::size_t{1} << 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) altitude_m[i] = std::max(altitude_m[i], level_m[at(basins.of_cell[i])]);
  });
}

Drainage find_drainage(Grid<float>& altitude_m, const std::vector<std::int32_t>& outlets, std::uint64_t seed) {
  fill_to_spill_level(altitude_m, outlets);
  Drainage drainage{find_receivers(altitude_m, outlets, seed), sort_cells(altitude_m)};
  std::vector<std::int32_t>& order = drainage.order;
  for (std::size_t first = 0; first < order.size();) {
    bool flat = false;
    std::size_t last = first;
    for (const float level = altitude_m[at(order[first])]; last < order.size() && altitude_m[at(order[last])] == level; ++last)
      flat = flat || drainage.receiver[at(order[last])] == is_flat;
    if (flat) order_flat(order, first, last, altitude_m, drainage.receiver);
    first = last;
  }
  return drainage;
}

Grid<float> catchments_km2(const Drainage& drainage, const Grid<float>& inflow_km2, double cell_m) {
  // The caller's grid gives the shape; without inflow every cell just has its own area.
  Grid<float> catchment = inflow_km2;
  const auto own = static_cast<float>(cell_m * cell_m * 1e-6);
  for (float& c : catchment) c += own;
  const std::vector<std::int32_t>& order = drainage.order;
  for (std::size_t k = order.size(); k-- > 0;) {
    // The order jumps about the map, but it is known: what comes next is on its way from memory.
    if (k >= ahead) {
      __builtin_prefetch(&drainage.receiver[at(order[k - ahead])]);
      __builtin_prefetch(&catchment[at(order[k - ahead])]);
    }
    const std::int32_t receiver = drainage.receiver[at(order[k])];
    if (receiver >= 0) catchment[at(receiver)] += catchment[at(order[k])];
  }
  return catchment;
}

}  // namespace belvedere::synthetic
