#include "terrain/shape/summits.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace belvedere {
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
