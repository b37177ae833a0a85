#include "terrain/shape/known_lakes.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace belvedere {
namespace {

constexpr double low_quantile = 0.3;
constexpr double max_off_m = 40.0;
constexpr double bank_m = 25.0;
// Below this quantile a lake's ground is level, except for this many metres, whatever its outline.
constexpr double level_from = 0.05;
constexpr double level_to = 0.5;
constexpr double max_fall_m = 15.0;

// Calls f(x, y) for the cells whose centres are enclosed by an odd number of rings, row by row.
template <class F>
void each_cell_in(const std::vector<std::vector<glm::dvec2>>& rings, const Dem& dem, F&& f) {
  double low = 0.0;
  double high = -1.0;
  for (const auto& ring : rings)
    for (const glm::dvec2 position : ring) {
      const double row = dem.transform.to_cell(position.x, position.y).y;
      low = high < low ? row : std::min(low, row);
      high = high < low ? row : std::max(high, row);
    }
  if (high < low) return;
  const int y0 =
      static_cast<int>(std::ceil(std::clamp(low, 0.0, static_cast<double>(dem.height()))));
  const int y1 = static_cast<int>(std::floor(std::clamp(high, -1.0, dem.height() - 1.0)));
  std::vector<double> crossings;
  for (int y = y0; y <= y1; ++y) {
    crossings.clear();
    for (const auto& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec2 a = dem.transform.to_cell(ring[i].x, ring[i].y);
        const glm::dvec2& next = ring[(i + 1) % ring.size()];
        const glm::dvec2 b = dem.transform.to_cell(next.x, next.y);
        if ((a.y <= y) != (b.y <= y))
          crossings.push_back(a.x + (y - a.y) * ((b.x - a.x) / (b.y - a.y)));
      }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      const int x0 = static_cast<int>(
          std::ceil(std::clamp(crossings[k], 0.0, static_cast<double>(dem.width()))));
      const int x1 =
          static_cast<int>(std::floor(std::clamp(crossings[k + 1], -1.0, dem.width() - 1.0)));
      for (int x = x0; x <= x1; ++x) f(x, y);
    }
  }
}

LakeLevel level_of(const Dem& dem, const KnownLake& lake) {
  std::vector<float> known;
  std::vector<float> all;
  each_cell_in(lake.rings, dem, [&](int x, int y) {
    all.push_back(dem.altitude_m(x, y));
    if (dem.filled.empty() || dem.filled(x, y) == 0) known.push_back(dem.altitude_m(x, y));
  });
  LakeLevel found;
  found.cells = all.size();
  if (all.empty()) return found;
  std::vector<float>& from = known.empty() ? all : known;
  std::sort(from.begin(), from.end());
  const auto quantile = [&](double share) {
    return static_cast<double>(
        from[static_cast<std::size_t>(share * static_cast<double>(from.size() - 1))]);
  };
  if (quantile(level_to) - quantile(level_from) > max_fall_m) {
    found.uneven = true;
    return found;
  }
  found.level_m = quantile(low_quantile);
  if (lake.level_m) {
    if (std::abs(*lake.level_m - *found.level_m) <= max_off_m)
      found.level_m = lake.level_m;
    else
      found.refused_level_m = lake.level_m;
  }
  std::size_t banks = 0;
  for (const float z : from) banks += static_cast<double>(z) > *found.level_m + bank_m ? 1 : 0;
  found.bank_share = static_cast<double>(banks) / static_cast<double>(from.size());
  return found;
}

}  // namespace

std::vector<LakeLevel> find_lake_levels(const Dem& dem, const std::vector<KnownLake>& lakes) {
  std::vector<LakeLevel> levels(lakes.size());
  parallel_ranges<std::size_t>(lakes.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) levels[i] = level_of(dem, lakes[i]);
  });
  return levels;
}

void level_known_lakes(Dem& dem, const std::vector<KnownLake>& lakes,
                       const std::vector<LakeLevel>& levels) {
  for (std::size_t i = 0; i < lakes.size(); ++i) {
    if (!levels[i].level_m) continue;
    const double level_m = *levels[i].level_m;
    each_cell_in(lakes[i].rings, dem, [&](int x, int y) {
      if (static_cast<double>(dem.altitude_m(x, y)) > level_m + bank_m) return;
      dem.altitude_m(x, y) = static_cast<float>(level_m);
      if (!dem.filled.empty()) dem.filled(x, y) = 0;
    });
  }
}

}  // namespace belvedere
