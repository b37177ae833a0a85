#include "terrain/synthetic/synthetic_erosion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "base/lines/power_line.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/rising_queue.h"
#include "terrain/shape/spill_level.h"
#include "terrain/synthetic/synthetic_plan.h"

namespace belvedere::synthetic {
namespace {

// A flood from cell to cell accesses the map at random and waits for memory at every step. Its
// result can be computed without it: it fills pits to their spill level and takes cells in the
// order of their filled altitude, so sorting gives its order.

constexpr int neighbour_x[8] = {-1, 0, 1, -1, 1, -1, 0, 1};
constexpr int neighbour_y[8] = {-1, -1, -1, 0, 0, 1, 1, 1};
constexpr bool is_diagonal[8] = {true, false, true, false, false, true, false, true};

constexpr std::size_t ahead = 16;  // cells
constexpr std::int32_t is_outlet = -1;
constexpr std::int32_t is_flat = -2;  // no lower neighbour

// Calls f(k, j) for the neighbours j of a cell, by ascending index.
template <class F>
void for_neighbours(const Grid<float>& grid, int x, int y, F&& f) {
  const int width = grid.width();
  const auto i = static_cast<std::int32_t>(grid.index(x, y));
  const bool inside = x > 0 && y > 0 && x + 1 < width && y + 1 < grid.height();
  for (int k = 0; k < 8; ++k)
    if (inside || grid.contains(x + neighbour_x[k], y + neighbour_y[k]))
      f(k, i + neighbour_y[k] * width + neighbour_x[k]);
}

// Cells by altitude, of equal ones by index: a radix sort by three parts of the key.
void sort_cells(const Grid<float>& altitude_m, Drainage& drainage) {
  constexpr int digits = 3;
  constexpr int bits = 11;
  constexpr std::size_t values = std::size_t{1} << bits;
  const auto digit_of = [](std::uint64_t key, int digit) {
    return static_cast<std::size_t>(key >> (32 + bits * digit)) & (values - 1);
  };
  std::array<std::array<std::uint32_t, values>, digits> positions{};
  auto& [receiver, order, keys, sorted] = drainage;
  keys.resize(altitude_m.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    keys[i] = rising_key(altitude_m[i], static_cast<std::uint32_t>(i));
    for (int digit = 0; digit < digits; ++digit)
      ++positions[static_cast<std::size_t>(digit)][digit_of(keys[i], digit)];
  }
  sorted.resize(keys.size());
  for (int digit = 0; digit < digits; ++digit) {
    auto& position = positions[static_cast<std::size_t>(digit)];
    std::exclusive_scan(position.begin(), position.end(), position.begin(), 0U);
    for (const std::uint64_t key : keys) sorted[position[digit_of(key, digit)]++] = key;
    keys.swap(sorted);
  }
  order.resize(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
    order[i] = static_cast<std::int32_t>(keys[i] & 0xffffffffU);
}

// Receivers by steepest descent on filled ground; is_flat if nothing is lower.
void find_receivers(const Grid<float>& filled_m, const std::vector<std::int32_t>& outlets,
                    std::uint64_t seed, std::vector<std::int32_t>& receivers) {
  receivers.resize(filled_m.size());
  const int width = filled_m.width();
  parallel_ranges(filled_m.height(), 8, [&](int begin, int end) {
    std::vector<float> diagonal(static_cast<std::size_t>(width));  // weight of a diagonal drop
    for (int y = begin; y != end; ++y) {
      const auto first = static_cast<std::int32_t>(filled_m.index(0, y));
      for (int x = 0; x < width; ++x)
        diagonal[at(x)] = 1.F / (2.F - static_cast<float>(random_uniform(seed, x, y)));
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
      // The same without branches, several cells at a time.
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
}

// Cells first … last of the order are equally high. The water reaches them from lower cells and
// outlets, and continues over the flat: always to the lowest adjacent index. The receiver of each
// flat cell is the one from which it was reached.
void order_flat(std::vector<std::int32_t>& order, std::size_t first, std::size_t last,
                const Grid<float>& filled_m, std::vector<std::int32_t>& receivers) {
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

Drainage find_drainage(Grid<float>& altitude_m, const std::vector<std::int32_t>& outlets,
                       std::uint64_t seed, Drainage memory) {
  Drainage drainage = std::move(memory);
  fill_to_spill_level(altitude_m, outlets, drainage.receiver);
  // These two are independent.
  parallel_ranges(2, 1, [&](int begin, int end) {
    for (int part = begin; part != end; ++part) {
      if (part == 0)
        sort_cells(altitude_m, drainage);
      else
        find_receivers(altitude_m, outlets, seed, drainage.receiver);
    }
  });
  std::vector<std::int32_t>& order = drainage.order;
  for (std::size_t first = 0; first < order.size();) {
    bool flat = false;
    std::size_t last = first;
    for (const float level = altitude_m[at(order[first])];
         last < order.size() && altitude_m[at(order[last])] == level; ++last)
      flat = flat || drainage.receiver[at(order[last])] == is_flat;
    if (flat) order_flat(order, first, last, altitude_m, drainage.receiver);
    first = last;
  }
  return drainage;
}

Grid<float> catchments_km2(const Drainage& drainage, const Grid<float>& inflow_km2, double cell_m) {
  // The caller's grid gives the shape; without inflow every cell starts with its own area.
  Grid<float> catchment = inflow_km2;
  const auto own = static_cast<float>(cell_m * cell_m * 1e-6);
  for (float& c : catchment) c += own;
  const std::vector<std::int32_t>& order = drainage.order;
  for (std::size_t k = order.size(); k-- > 0;) {
    // The order accesses the map at random, but is known: the next cells are prefetched.
    if (k >= ahead) {
      __builtin_prefetch(&drainage.receiver[at(order[k - ahead])]);
      __builtin_prefetch(&catchment[at(order[k - ahead])]);
    }
    const std::int32_t receiver = drainage.receiver[at(order[k])];
    if (receiver >= 0) catchment[at(receiver)] += catchment[at(order[k])];
  }
  return catchment;
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Distance to the receiver in cells.
float step_cells(std::int32_t from, std::int32_t to, int width) {
  const std::int32_t d = std::abs(from - to);
  return d == 1 || d == width ? 1.F : 1.41421356F;
}

// Solves w = c - a g and g <= limit, w the altitude above the lower of the neighbours in x and y, d
// the height difference of these two. The upwind gradient g = sqrt(w² + max(0, w - d)²) (Rouy &
// Tourin 1992), in metres per cell, does not depend on direction; the eight flow directions would
// leave artefacts on every slope.
double upwind_rise(double c, double d, double a, double limit) {
  if (c <= 0.0) return c;
  double w = c / (1.0 + a);
  if (w > d) {
    const double b = c - a * a * d;
    w = (c * c - a * a * d * d) /
        (b + std::sqrt(b * b - (2.0 * a * a - 1.0) * (a * a * d * d - c * c)));
  }
  const double steepest = limit > d ? 0.5 * (d + std::sqrt(2.0 * limit * limit - d * d)) : limit;
  return std::min(w, steepest);
}

}  // namespace

void erode(Grid<float>& altitude_m, const Drainage& drainage, const Grid<float>& catchment_km2,
           const Grid<float>& uplift_m, const Grid<float>& softness,
           const ErosionParameters& parameters, Grid<ErosionCell>& memory) {
  const int width = altitude_m.width();
  const auto reach = static_cast<float>(240.0 * parameters.unit_m / parameters.cell_m);
  const auto area_unit = static_cast<float>(parameters.unit_m * parameters.unit_m);
  constexpr float unknown = std::numeric_limits<float>::infinity();
  if (!memory.same_size(altitude_m)) memory = Grid<ErosionCell>(width, altitude_m.height());
  Grid<ErosionCell>& cells = memory;
  parallel_rows(altitude_m.height(), [&](int y) {
    std::vector<float> water(static_cast<std::size_t>(width));
    for (int x = 0; x < width; ++x)
      water[at(x)] = catchment_km2(x, y) / area_unit + parameters.hillslope_km2;
    power_line(water.data(), 0.6, width, water.data());
    for (int x = 0; x < width; ++x) {
      const std::size_t i = altitude_m.index(x, y);
      cells[i] = {
          unknown, altitude_m[i] + parameters.step * uplift_m[i],
          reach * parameters.step * softness[i] * water[at(x)],
          parameters.steepest * static_cast<float>(parameters.cell_m) * (0.6F + 0.4F / softness[i]),
          drainage.receiver[i]};
    }
  });
  // New altitude of the lower of two opposite neighbours that are done; else infinity.
  const auto lower = [&](bool one, std::size_t a, bool two, std::size_t b) {
    const float z = one ? cells[a].altitude_m : unknown;
    return static_cast<double>(two ? std::min(z, cells[b].altitude_m) : z);
  };
  const auto stride = static_cast<std::size_t>(width);
  constexpr std::size_t ahead = 16;  // cells whose neighbourhoods are prefetched
  for (std::size_t k = 0; k < drainage.order.size(); ++k) {
    if (k + ahead < drainage.order.size()) {
      const std::size_t next = at(drainage.order[k + ahead]);
      __builtin_prefetch(&cells[next]);
      if (next >= stride) __builtin_prefetch(&cells[next - stride]);
      if (next + stride < cells.size()) __builtin_prefetch(&cells[next + stride]);
    }
    const std::int32_t index = drainage.order[k];
    const std::size_t i = at(index);
    ErosionCell& cell = cells[i];
    if (cell.receiver < 0) {
      cell.altitude_m = altitude_m[i];
      continue;
    }
    const int x = index % width;
    const int y = index / width;
    // Along the flow path: relevant in a channel.
    const float length = step_cells(index, cell.receiver, width);
    const float f = cell.incision / length;
    const float below = cells[at(cell.receiver)].altitude_m;
    float z = std::min((cell.risen_m + f * below) / (1.F + f), below + cell.limit_m * length);
    // Along the true gradient: relevant on a slope.
    const double lower_x = lower(x > 0, i - 1, x + 1 < width, i + 1);
    const double lower_y = lower(y > 0, i - stride, y + 1 < altitude_m.height(), i + stride);
    const double low = std::min(lower_x, lower_y);
    if (low < infinity)
      z = std::min(z, static_cast<float>(low + upwind_rise(static_cast<double>(cell.risen_m) - low,
                                                           std::max(lower_x, lower_y) - low,
                                                           static_cast<double>(cell.incision),
                                                           static_cast<double>(cell.limit_m))));
    cell.altitude_m = z;
  }
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x < width; ++x)
      if (cells(x, y).altitude_m < unknown) altitude_m(x, y) = cells(x, y).altitude_m;
  });
}

void creep(Grid<float>& altitude_m, float rate) {
  const Grid<float> before = altitude_m;
  parallel_rows(altitude_m.height() - 2, [&](int row) {
    const int y = row + 1;
    for (int x = 1; x + 1 < altitude_m.width(); ++x) {
      const float straight =
          before(x - 1, y) + before(x + 1, y) + before(x, y - 1) + before(x, y + 1);
      const float diagonal =
          before(x - 1, y - 1) + before(x + 1, y - 1) + before(x - 1, y + 1) + before(x + 1, y + 1);
      // Weights 4:1 make the nine-point Laplacian isotropic.
      altitude_m(x, y) += rate * ((4.F * straight + diagonal) / 20.F - before(x, y));
    }
  });
}

}  // namespace belvedere::synthetic
