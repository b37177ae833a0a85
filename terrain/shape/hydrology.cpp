#include "terrain/shape/hydrology.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <vector>

#include "base/parallel.h"

namespace belvedere {
namespace {

struct Step {
  int x;
  int y;
};
// The eight neighbours; the opposite of neighbour k is 7 - k.
constexpr std::array<Step, 8> neighbours{{{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};
constexpr std::uint8_t drains_out = 8;  // leaves the grid
constexpr std::uint8_t not_seen = 255;

// Bits that sort as the floats do.
std::uint64_t sortable(float altitude) {
  const auto bits = std::bit_cast<std::uint32_t>(altitude + 0.F);  // one zero only
  return bits & 0x80000000U ? ~bits : bits | 0x80000000U;
}

// A flooded terrain: where each cell drains to, and all cells in an order in which nothing drains upwards.
struct Flood {
  Grid<float> level_m;               // altitude with its hollows filled
  Grid<std::uint8_t> towards;        // which neighbour, or drains_out
  std::vector<std::uint32_t> order;  // rising levels
};

Flood flood_from_rim(const Grid<float>& altitude_m) {
  const int width = altitude_m.width();
  const int height = altitude_m.height();
  Flood flood{altitude_m, Grid<std::uint8_t>(width, height, not_seen), {}};
  flood.order.reserve(altitude_m.size());
  // Altitude above, cell below: equal altitudes come in the order of their cells.
  std::priority_queue<std::uint64_t, std::vector<std::uint64_t>, std::greater<>> rising;
  const auto push = [&](std::size_t cell) { rising.push(sortable(flood.level_m[cell]) << 32 | cell); };
  for (int y = 0; y < height; ++y) {
    const bool whole_row = y == 0 || y == height - 1;
    for (int x = 0; x < width; x += whole_row ? 1 : std::max(1, width - 1)) {
      flood.towards(x, y) = drains_out;
      push(altitude_m.index(x, y));
    }
  }
  // Cells of a hollow need no sorting: all stand at the level of its outlet. They wait at the end of `order` itself.
  std::size_t next = 0;
  while (next < flood.order.size() || !rising.empty()) {
    if (next == flood.order.size()) {
      flood.order.push_back(static_cast<std::uint32_t>(rising.top() & 0xffffffffU));
      rising.pop();
    }
    const std::size_t cell = flood.order[next++];
    const float level = flood.level_m[cell];
    const int x = static_cast<int>(cell % static_cast<std::size_t>(width));
    const int y = static_cast<int>(cell / static_cast<std::size_t>(width));
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      const int u = x + neighbours[k].x;
      const int v = y + neighbours[k].y;
      if (!altitude_m.contains(u, v) || flood.towards(u, v) != not_seen) continue;
      flood.towards(u, v) = static_cast<std::uint8_t>(7 - k);
      const std::size_t other = altitude_m.index(u, v);
      if (flood.level_m[other] <= level) {
        flood.level_m[other] = level;
        flood.order.push_back(static_cast<std::uint32_t>(other));
      } else {
        push(other);
      }
    }
  }
  return flood;
}

// Where the flooded surface falls, water takes the steepest way, also inwards from the rim. A lower cell was flooded earlier, so
// the order still holds and there is no circle.
void turn_to_steepest_descent(Flood& flood) {
  parallel_rows(flood.level_m.height(), [&](int y) {
    for (int x = 0; x < flood.level_m.width(); ++x) {
      float steepest = 0.F;
      for (std::size_t k = 0; k < neighbours.size(); ++k) {
        const auto [dx, dy] = neighbours[k];
        if (!flood.level_m.contains(x + dx, y + dy)) continue;
        const float fall = flood.level_m(x, y) - flood.level_m(x + dx, y + dy);
        const float slope = dx != 0 && dy != 0 ? fall * 0.70710678F : fall;
        if (slope > steepest) {
          steepest = slope;
          flood.towards(x, y) = static_cast<std::uint8_t>(k);
        }
      }
    }
  });
}

using Mask = Grid<std::uint8_t>;

// One step of erosion (a cell stays if its four neighbours are set) or dilation (it comes if one is); outside is like the border.
template <bool erode>
Mask morph(const Mask& mask) {
  Mask out(mask.width(), mask.height());
  parallel_rows(mask.height(), [&](int y) {
    for (int x = 0; x < mask.width(); ++x) {
      const std::array<std::uint8_t, 5> cross{mask(x, y), mask.clamped(x - 1, y), mask.clamped(x + 1, y), mask.clamped(x, y - 1),
                                              mask.clamped(x, y + 1)};
      const auto set = [](std::uint8_t m) { return m != 0; };
      out(x, y) = erode ? std::all_of(cross.begin(), cross.end(), set) : std::any_of(cross.begin(), cross.end(), set);
    }
  });
  return out;
}

Mask find_flat_cells(const Grid<float>& altitude_m, float max_range_m) {
  Mask flat(altitude_m.width(), altitude_m.height());
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x < altitude_m.width(); ++x) {
      float low = altitude_m(x, y);
      float high = low;
      for (const auto& [dx, dy] : neighbours) {
        const float z = altitude_m.clamped(x + dx, y + dy);
        low = std::min(low, z);
        high = std::max(high, z);
      }
      flat(x, y) = high - low < max_range_m;
    }
  });
  return flat;
}

// Mean height of the ground `bank_distance` cells around a piece above its level, each cell counted within ±2 m; `stamps` holds
// what was visited under numbers that no other piece has.
constexpr int bank_distance = 7;

float bank_height_m(const Grid<float>& altitude_m, const Mask& mask, const std::vector<Step>& piece, Grid<std::int32_t>& stamps,
                    std::int32_t number) {
  std::vector<Step> shore;
  for (const Step& cell : piece) {
    for (const auto& [dx, dy] : neighbours) {
      if (mask.clamped(cell.x + dx, cell.y + dy) == 0) {
        shore.push_back(cell);
        break;
      }
    }
  }
  const std::int32_t near = 2 * number;
  const std::int32_t counted = near + 1;
  for (const Step& cell : piece) stamps(cell.x, cell.y) = near;
  for (const Step& cell : shore) {
    for (int y = cell.y - bank_distance + 1; y < cell.y + bank_distance; ++y) {
      for (int x = cell.x - bank_distance + 1; x < cell.x + bank_distance; ++x) {
        if (stamps.contains(x, y)) stamps(x, y) = near;
      }
    }
  }
  const float level_m = altitude_m(piece[0].x, piece[0].y);
  double sum = 0.0;
  int count = 0;
  const auto visit = [&](int x, int y) {
    if (!stamps.contains(x, y) || stamps(x, y) == near || stamps(x, y) == counted) return;
    stamps(x, y) = counted;
    sum += std::clamp(altitude_m(x, y) - level_m, -2.F, 2.F);
    ++count;
  };
  for (const Step& cell : shore) {
    for (int i = -bank_distance; i <= bank_distance; ++i) {
      visit(cell.x + i, cell.y - bank_distance);
      visit(cell.x + i, cell.y + bank_distance);
      visit(cell.x - bank_distance, cell.y + i);
      visit(cell.x + bank_distance, cell.y + i);
    }
  }
  // A lake that fills the whole grid has no banks to ask.
  return count == 0 ? 2.F : static_cast<float>(sum / count);
}

// Clears the pieces that are too small or have no banks.
void remove_what_is_no_lake(Mask& mask, const Grid<float>& altitude_m, const LakeParameters& parameters) {
  const Mask flat = mask;
  Mask seen(mask.width(), mask.height());
  Grid<std::int32_t> stamps(mask.width(), mask.height());
  std::int32_t number = 0;
  std::vector<Step> piece;
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      if (flat(x, y) == 0 || seen(x, y) != 0) continue;
      piece.assign(1, {x, y});
      seen(x, y) = 1;
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const Step here = piece[i];
        for (const auto& [dx, dy] : {Step{-1, 0}, Step{1, 0}, Step{0, -1}, Step{0, 1}}) {
          const Step next{here.x + dx, here.y + dy};
          if (!flat.contains(next.x, next.y) || flat(next.x, next.y) == 0 || seen(next.x, next.y) != 0) continue;
          seen(next.x, next.y) = 1;
          piece.push_back(next);
        }
      }
      const bool large = piece.size() >= static_cast<std::size_t>(std::max(parameters.min_cells, 0));
      if (large && (parameters.min_bank_m <= 0.F || bank_height_m(altitude_m, flat, piece, stamps, ++number) >= parameters.min_bank_m)) {
        continue;
      }
      for (const Step& cell : piece) mask(cell.x, cell.y) = 0;
    }
  }
}

}  // namespace

Grid<float> flow_accumulation_km2(const Grid<float>& altitude_m, double cell_m) {
  Grid<float> catchment(altitude_m.width(), altitude_m.height());
  Flood flood = flood_from_rim(altitude_m);
  turn_to_steepest_descent(flood);
  flood.level_m = {};
  // Whole cells are counted, exactly; then turned into km².
  Grid<std::uint32_t> cells(altitude_m.width(), altitude_m.height(), 1);
  const double cell_km2 = cell_m * cell_m * 1e-6;
  for (auto i = flood.order.rbegin(); i != flood.order.rend(); ++i) {
    const std::size_t cell = *i;
    // Above 2^24 cells a float cannot tell n from n + 1: what came from upstream is the least it may be.
    catchment[cell] = std::max(catchment[cell], static_cast<float>(cells[cell] * cell_km2));
    const std::uint8_t k = flood.towards[cell];
    if (k == drains_out) continue;
    const auto target = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(cell) + neighbours[k].x +
                                                 static_cast<std::ptrdiff_t>(neighbours[k].y) * altitude_m.width());
    cells[target] += cells[cell];
    catchment[target] = std::max(catchment[target], std::nextafter(catchment[cell], std::numeric_limits<float>::infinity()));
  }
  return catchment;
}

Grid<float> fill_hollows(const Grid<float>& altitude_m) { return flood_from_rim(altitude_m).level_m; }

Grid<std::uint8_t> find_lakes(const Grid<float>& altitude_m, const LakeParameters& parameters) {
  Mask lakes = find_flat_cells(altitude_m, parameters.max_range_m);
  lakes = morph<false>(morph<false>(morph<true>(morph<true>(lakes))));
  remove_what_is_no_lake(lakes, altitude_m, parameters);
  // The neighbourhood of a flat cell is flat as well: a cell at its rim still stands at the lake's level.
  Mask grown = lakes;
  parallel_rows(lakes.height(), [&](int y) {
    for (int x = 0; x < lakes.width(); ++x) {
      for (const auto& [dx, dy] : neighbours) {
        if (lakes.clamped(x + dx, y + dy) == 0) continue;
        if (std::abs(altitude_m.clamped(x + dx, y + dy) - altitude_m(x, y)) < parameters.max_range_m) grown(x, y) = 1;
      }
    }
  });
  return grown;
}

}  // namespace belvedere
