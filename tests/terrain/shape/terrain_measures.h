#pragma once

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>
#include <vector>

#include "base/grid.h"

// Measures for comparing terrains in tests.
namespace belvedere {

// Hollows filled to their outlet by a plain priority flood from the border: an independent
// implementation, as an oracle.
inline Grid<float> filled_hollows(const Grid<float>& altitude_m) {
  using Place = std::tuple<float, int, int>;
  std::priority_queue<Place, std::vector<Place>, std::greater<>> open;
  Grid<unsigned char> seen(altitude_m.width(), altitude_m.height());
  Grid<float> out = altitude_m;
  const auto push = [&](int x, int y, float level) {
    if (!out.contains(x, y) || seen(x, y) != 0) return;
    seen(x, y) = 1;
    out(x, y) = std::max(altitude_m(x, y), level);
    open.emplace(out(x, y), x, y);
  };
  for (int x = 0; x < out.width(); ++x) {
    push(x, 0, -1e9F);
    push(x, out.height() - 1, -1e9F);
  }
  for (int y = 0; y < out.height(); ++y) {
    push(0, y, -1e9F);
    push(out.width() - 1, y, -1e9F);
  }
  while (!open.empty()) {
    const auto [level, x, y] = open.top();
    open.pop();
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) push(x + dx, y + dy, level);
  }
  return out;
}

// Volume of all hollows, m³.
inline double pit_volume_m3(const Grid<float>& altitude_m, double cell_m) {
  const Grid<float> filled = filled_hollows(altitude_m);
  double sum = 0.0;
  for (std::size_t i = 0; i < filled.size(); ++i)
    sum += static_cast<double>(filled[i]) - altitude_m[i];
  return sum * cell_m * cell_m;
}

}  // namespace belvedere
