#include "terrain/shape/spill_level.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "base/parallel.h"

namespace belvedere {
namespace {

// A flood accesses the map at random and waits for memory at every step. Its result can be computed
// without it: every cell runs down to the bottom of its basin, and a basin fills up to the highest
// pass on its lowest path to an outlet, which lies in the minimum spanning tree of basins
// (Cordonnier, Bovy & Braun 2019). Almost all of that runs row by row.

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// The lowest of a cell and its neighbours. Among equally high cells a lower index counts as lower,
// so that a flat has one bottom or leads on.
std::int32_t lowest_around(const Grid<float>& altitude_m, int x, int y) {
  auto to = static_cast<std::int32_t>(altitude_m.index(x, y));
  float z = altitude_m(x, y);
  for (int v = y - 1; v <= y + 1; ++v) {
    for (int u = x - 1; u <= x + 1; ++u) {
      if (!altitude_m.contains(u, v) || (u == x && v == y)) continue;
      const float there = altitude_m(u, v);
      const bool before = v < y || (v == y && u < x);
      if (before ? there > z : there >= z) continue;
      to = static_cast<std::int32_t>(altitude_m.index(u, v));
      z = there;
    }
  }
  return to;
}

// Receiver of each cell: its lowest neighbour; bottoms of basins and outlets are their own.
void find_descents(const Grid<float>& altitude_m, std::span<const std::int32_t> outlets,
                   std::vector<std::int32_t>& descent) {
  descent.resize(altitude_m.size());
  const int width = altitude_m.width();
  parallel_rows(altitude_m.height(), [&](int y) {
    std::int32_t* const out = &descent[altitude_m.index(0, y)];
    if (y == 0 || y + 1 == altitude_m.height()) {
      for (int x = 0; x < width; ++x) out[x] = lowest_around(altitude_m, x, y);
      return;
    }
    out[0] = lowest_around(altitude_m, 0, y);
    out[width - 1] = lowest_around(altitude_m, width - 1, y);
    // The same without branches, several cells at a time.
    const float* const above = altitude_m.row(y - 1);
    const float* const here = altitude_m.row(y);
    const float* const below = altitude_m.row(y + 1);
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
}

// Basin 0 contains everything that runs to an outlet, the others end in pits.
struct Basins {
  std::vector<std::int32_t> of_cell;
  int count = 1;
};

Basins find_basins(std::vector<std::int32_t> descent, std::span<const std::int32_t> outlets) {
  // In place: cells with a known basin store it with its bits inverted, so that it is negative.
  for (const std::int32_t i : outlets) descent[at(i)] = ~0;
  Basins basins;
  std::vector<std::int32_t> way;
  for (std::size_t start = 0; start < descent.size(); ++start) {
    auto i = static_cast<std::int32_t>(start);
    for (; descent[at(i)] >= 0 && descent[at(i)] != i; i = descent[at(i)]) way.push_back(i);
    if (descent[at(i)] == i) descent[at(i)] = ~basins.count++;
    for (const std::int32_t cell : way) descent[at(cell)] = descent[at(i)];
    way.clear();
  }
  parallel_ranges(descent.size(), std::size_t{1} << 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) descent[i] = ~descent[i];
  });
  basins.of_cell = std::move(descent);
  return basins;
}

// A pass from one basin into another.
struct Pass {
  float level_m;
  std::int32_t one;
  std::int32_t other;
};

std::vector<Pass> find_passes(const Grid<float>& altitude_m, const Basins& basins) {
  const int width = altitude_m.width();
  const int height = altitude_m.height();
  constexpr int band = 64;  // rows
  std::vector<std::vector<Pass>> of_bands(static_cast<std::size_t>((height + band - 1) / band));
  parallel_rows(static_cast<int>(of_bands.size()), [&](int number) {
    std::vector<Pass>& passes = of_bands[at(number)];
    for (int y = number * band; y < std::min(height, (number + 1) * band); ++y) {
      for (int x = 0; x < width; ++x) {
        const std::size_t i = altitude_m.index(x, y);
        const std::int32_t basin = basins.of_cell[i];
        // Consecutive passes along a border are reduced to the lowest.
        const auto look = [&](std::size_t j) {
          const std::int32_t beside = basins.of_cell[j];
          if (basin == beside) return;
          const Pass pass{std::max(altitude_m[i], altitude_m[j]), std::min(basin, beside),
                          std::max(basin, beside)};
          if (passes.empty() || passes.back().one != pass.one || passes.back().other != pass.other)
            passes.push_back(pass);
          else
            passes.back().level_m = std::min(passes.back().level_m, pass.level_m);
        };
        if (x + 1 < width) look(i + 1);
        if (y + 1 == height) continue;
        const std::size_t under = i + at(width);
        if (x > 0) look(under - 1);
        look(under);
        if (x + 1 < width) look(under + 1);
      }
    }
  });
  std::vector<Pass> passes;
  for (const std::vector<Pass>& of_band : of_bands)
    passes.insert(passes.end(), of_band.begin(), of_band.end());
  return passes;
}

// The level up to which each basin fills: passes are opened from the lowest on, and basins that
// become connected to the outlets by one spill at its level (Kruskal 1956).
std::vector<float> find_spill_levels(std::vector<Pass> passes, int basins) {
  std::sort(passes.begin(), passes.end(),
            [](const Pass& a, const Pass& b) { return a.level_m < b.level_m; });
  const auto count = static_cast<std::size_t>(basins);
  std::vector<float> level_m(count, -std::numeric_limits<float>::infinity());
  std::vector<std::int32_t> parent(count);
  std::iota(parent.begin(), parent.end(), 0);
  // Rings of the joined basins, by the next one.
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

}  // namespace

void fill_to_spill_level(Grid<float>& altitude_m, std::span<const std::int32_t> outlets,
                         std::vector<std::int32_t>& memory) {
  find_descents(altitude_m, outlets, memory);
  Basins basins = find_basins(std::move(memory), outlets);
  if (basins.count > 1) {
    const std::vector<float> level_m =
        find_spill_levels(find_passes(altitude_m, basins), basins.count);
    parallel_ranges(altitude_m.size(), std::size_t{1} << 16,
                    [&](std::size_t begin, std::size_t end) {
                      for (std::size_t i = begin; i != end; ++i)
                        altitude_m[i] = std::max(altitude_m[i], level_m[at(basins.of_cell[i])]);
                    });
  }
  memory = std::move(basins.of_cell);
}

void fill_to_spill_level(Grid<float>& altitude_m, std::span<const std::int32_t> outlets) {
  std::vector<std::int32_t> memory;
  fill_to_spill_level(altitude_m, outlets, memory);
}

}  // namespace belvedere
