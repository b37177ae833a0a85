#include "terrain/cover/ground_lakes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "base/statistics.h"
#include "terrain/shape/mask_pieces.h"

namespace belvedere {

Grid<std::uint8_t> find_hole_lakes(const Dem& dem, int min_cells, const Mask& known) {
  Mask lakes(dem.width(), dem.height(), 0);
  std::vector<float> shore;
  each_piece(dem.filled, 1, [&](const std::vector<std::int32_t>& cells) {
    if (cells.size() < static_cast<std::size_t>(std::max(1, min_cells))) return;
    shore.clear();
    const bool over_rim = std::any_of(cells.begin(), cells.end(), [&](std::int32_t at) {
      return at_edge(lakes, at % dem.width(), at / dem.width());
    });
    if (over_rim) {  // its extent beyond is unknown
      const auto in_lake = std::count_if(cells.begin(), cells.end(), [&](std::int32_t at) {
        return !known.empty() && known[static_cast<std::size_t>(at)] != 0;
      });
      if (2 * static_cast<std::size_t>(in_lake) > cells.size())
        for (const std::int32_t at : cells) lakes[static_cast<std::size_t>(at)] = 1;
      return;
    }
    for (const std::int32_t at : cells) {
      const int x = at % dem.width();
      const int y = at / dem.width();
      for (const auto& [dx, dy] :
           {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}})
        if (dem.filled.contains(x + dx, y + dy) && dem.filled(x + dx, y + dy) == 0)
          shore.push_back(dem.altitude_m(x + dx, y + dy));
    }
    if (shore.size() < 4) return;
    std::sort(shore.begin(), shore.end());
    if (shore[shore.size() / 2] - shore[shore.size() / 20] > 1.F) return;
    for (const std::int32_t at : cells) lakes[static_cast<std::size_t>(at)] = 1;
  });
  return lakes;
}

namespace {

// Lakes keep their minimum area on coarser cells, down to the smallest patch that is not a speck.
int lake_cells(int data_cells, int halved) {
  constexpr int min = 25;
  return halved == 0 ? data_cells : std::max(std::min(data_cells, min), data_cells >> (2 * halved));
}

}  // namespace

Grid<std::uint8_t> ground_lakes(const Dem& dem, LakeParameters parameters, const Sea& sea,
                                const Grid<std::uint8_t>& known) {
  parameters.min_cells = lake_cells(parameters.min_cells, dem.halved);
  Grid<std::uint8_t> mask = find_lakes(dem.altitude_m, parameters);
  const Grid<std::uint8_t> holes = find_hole_lakes(dem, parameters.min_cells, known);
  for (std::size_t i = 0; i < mask.size(); ++i)
    mask[i] = static_cast<std::uint8_t>(!sea.empty() && sea.mask[i] != 0 ? 0 : mask[i] | holes[i]);
  return mask;
}

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
  const std::vector<float>& from = known.empty() ? all : known;
  const auto quantile = [&](double share) {
    return static_cast<double>(value_at_share(from, share));
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
