#include "terrain/shape/valley_floor.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/filter.h"
#include "base/parallel.h"
#include "terrain/shape/derivatives.h"

namespace belvedere {

Grid<std::uint8_t> find_valley_floor(const Grid<float>& altitude_m, double cell_m,
                                     const ValleyFloorParameters& parameters) {
  // Filters spread NaN: voids are replaced by the lowest ground, and are not floor themselves.
  Grid<float> known = altitude_m;
  float lowest = 0.F;
  for (const float z : altitude_m)
    if (!std::isnan(z)) lowest = std::min(lowest, z);
  for (float& z : known)
    if (std::isnan(z)) z = lowest;
  const Grid<float> slope = slope_deg(gaussian_blur(known, 60.0 / cell_m), cell_m, cell_m);
  const Grid<float> above = height_above_valley(known, cell_m, 900.0);
  const Grid<float> highest = window_maximum(known, static_cast<int>(std::lround(3000.0 / cell_m)));
  Grid<std::uint8_t> floor(altitude_m.width(), altitude_m.height(), 0);
  parallel_rows(floor.height(), [&](int y) {
    for (int x = 0; x < floor.width(); ++x) {
      const bool flat = static_cast<double>(slope(x, y)) <= parameters.steepest_deg;
      const bool low = static_cast<double>(above(x, y)) <= parameters.above_lowest_m;
      const bool enclosed =
          static_cast<double>(highest(x, y) - known(x, y)) >= parameters.below_highest_m;
      floor(x, y) = flat && low && enclosed && !std::isnan(altitude_m(x, y)) ? 1 : 0;
    }
  });
  return floor;
}

Surrounded surround(const Grid<float>& own, const GeoTransform& t, const Dem& whole,
                    double reach_m) {
  // As many cells on each side as the whole has ground for.
  const auto fit = [&](double room_m, double cell_m) {
    return static_cast<int>(std::floor(std::clamp(room_m, 0.0, reach_m) / cell_m + 1e-6));
  };
  const GeoTransform& all = whole.transform;
  Surrounded out;
  out.left = fit(t.origin_x - all.origin_x, t.cell_x);
  out.top = fit(all.origin_y - t.origin_y, t.cell_y);
  const int right = fit(
      all.origin_x + whole.width() * all.cell_x - t.origin_x - own.width() * t.cell_x, t.cell_x);
  const int bottom = fit(
      t.origin_y - own.height() * t.cell_y - all.origin_y + whole.height() * all.cell_y, t.cell_y);
  out.altitude_m = Grid<float>(out.left + own.width() + right, out.top + own.height() + bottom);
  out.transform = {t.origin_x - out.left * t.cell_x, t.origin_y + out.top * t.cell_y, t.cell_x,
                   t.cell_y};
  parallel_rows(out.altitude_m.height(), [&](int y) {
    for (int x = 0; x < out.altitude_m.width(); ++x) {
      if (own.contains(x - out.left, y - out.top)) {
        out.altitude_m(x, y) = own(x - out.left, y - out.top);
        continue;
      }
      const glm::dvec2 position = out.transform.to_crs(x, y);
      const glm::dvec2 cell = all.to_cell(position.x, position.y);
      out.altitude_m(x, y) = sample_bilinear(whole.altitude_m, cell.x, cell.y);
    }
  });
  return out;
}

namespace {

// Altitude above position, ordered so that keys fall as the sea level falls: high cells first, of
// equal ones the first in the grid.
std::uint64_t rank_of(float altitude_m, std::size_t position) {
  const auto bits = std::bit_cast<std::uint32_t>(altitude_m);
  const std::uint32_t rising =
      (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;  // in numerical order
  return (static_cast<std::uint64_t>(~rising) << 32) | position;
}

// Islands above a falling sea level; the root of each is its highest cell.
class Islands {
 public:
  explicit Islands(std::size_t cells) : parent_(cells, under_water) {}

  bool is_land(std::size_t cell) const { return parent_[cell] != under_water; }
  void rise(std::size_t cell) { parent_[cell] = static_cast<std::uint32_t>(cell); }
  std::size_t top(std::size_t cell) {
    while (parent_[cell] != cell) {
      parent_[cell] = parent_[parent_[cell]];
      cell = parent_[cell];
    }
    return cell;
  }
  void join(std::size_t higher, std::size_t lower) {
    parent_[lower] = static_cast<std::uint32_t>(higher);
  }

 private:
  static constexpr std::uint32_t under_water = ~std::uint32_t{0};
  std::vector<std::uint32_t> parent_;
};

bool is_inside(const Grid<float>& altitude_m, int x, int y) {
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (!altitude_m.contains(x + dx, y + dy) || std::isnan(altitude_m(x + dx, y + dy)))
        return false;
  return true;
}

}  // namespace

// The sea level falls from the highest cell; every summit appears as an island, and where two
// islands meet, the lower one has its saddle.
std::vector<Summit> find_summits(const Grid<float>& altitude_m,
                                 const SummitParameters& parameters) {
  std::vector<std::uint64_t> order;
  order.reserve(altitude_m.size());
  for (std::size_t i = 0; i < altitude_m.size(); ++i)
    if (!std::isnan(altitude_m[i])) order.push_back(rank_of(altitude_m[i], i));
  std::sort(order.begin(), order.end());

  std::vector<Summit> found;
  const auto w = static_cast<std::size_t>(altitude_m.width());
  const auto note = [&](std::size_t top, float saddle_m) {
    const int x = static_cast<int>(top % w);
    const int y = static_cast<int>(top / w);
    const float prominence_m = altitude_m[top] - saddle_m;
    if (static_cast<double>(prominence_m) >= parameters.min_prominence_m &&
        is_inside(altitude_m, x, y))
      found.push_back({x, y, altitude_m[top], prominence_m});
  };
  Islands islands(altitude_m.size());
  for (const std::uint64_t rank : order) {
    const std::size_t cell = rank & 0xFFFFFFFFU;
    islands.rise(cell);
    const int x = static_cast<int>(cell % w);
    const int y = static_cast<int>(cell / w);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (!altitude_m.contains(x + dx, y + dy)) continue;
        const std::size_t beside = altitude_m.index(x + dx, y + dy);
        if (beside == cell || !islands.is_land(beside)) continue;
        const std::size_t a = islands.top(cell);
        const std::size_t b = islands.top(beside);
        if (a == b) continue;
        const bool a_is_higher = rank_of(altitude_m[a], a) < rank_of(altitude_m[b], b);
        const std::size_t lower = a_is_higher ? b : a;
        if (lower != cell) note(lower, altitude_m[cell]);
        islands.join(a_is_higher ? a : b, lower);
      }
  }
  // The remaining islands are separated by voids.
  for (const std::uint64_t rank : order) {
    const std::size_t cell = rank & 0xFFFFFFFFU;
    if (islands.top(cell) == cell) note(cell, altitude_m[order.back() & 0xFFFFFFFFU]);
  }
  const auto first = [](const Summit& a, const Summit& b) {
    if (a.prominence_m != b.prominence_m) return a.prominence_m > b.prominence_m;
    return a.y != b.y ? a.y < b.y : a.x < b.x;
  };
  std::sort(found.begin(), found.end(), first);
  if (found.size() > parameters.max) found.resize(parameters.max);
  return found;
}

}  // namespace belvedere
