#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/grid.h"
#include "base/land_cover_class.h"
#include "base/progress.h"
#include "terrain/climate/climate.h"
#include "terrain/climate/default_climate.h"
#include "terrain/climate/map_climate.h"
#include "terrain/cover/class_rules.h"
#include "terrain/io/crs.h"
#include "terrain/io/dem.h"
#include "tests/grids.h"

namespace belvedere::test {

struct MountainPlace {
  const char* name;
  double latitude_deg;
  double longitude_deg;
  double floor_m;  // altitude of the valley
  double top_m;    // and of the crests, 6 km from it
};

// A valley with side valleys between two ranges, 12 km square, at a place on the Earth.
inline Dem ground_at(const MountainPlace& place) {
  constexpr int size = 80;
  constexpr double cell = 150.0;
  Dem dem;
  dem.altitude_m = Grid<float>(size, size);
  dem.filled = Grid<std::uint8_t>(size, size, 0);
  dem.transform = {-0.5 * size * cell, 0.5 * size * cell, cell, cell};
  dem.crs = normalize_crs(fmt::format("+proj=laea +lat_0={} +lon_0={} +datum=WGS84 +units=m",
                                      place.latitude_deg, place.longitude_deg));
  for (const auto [x, y] : test::cells(size, size)) {
    const double east = x * cell;
    const double away = std::abs((y - size / 2) * cell + 250.0 * std::sin(east / 1300.0));
    const double up = std::clamp((away - 1200.0) / 4300.0, 0.0, 1.0);
    const double crests = 1.0 + 0.15 * std::sin(east / 450.0 + y * 0.05);
    dem.altitude_m(x, y) = static_cast<float>(
        place.floor_m + (place.top_m - place.floor_m) * std::pow(up, 1.3) * crests + 0.006 * away +
        0.001 * east);
  }
  return dem;
}

// Land cover by the built-in rules and climate, or another one.
inline Grid<LandCoverClass> cover_at(
    const Dem& dem, const DefaultClimate& at = [](glm::dvec2 lonlat) {
      return default_climate(lonlat.x, lonlat.y);
    }) {
  const Climate climate = make_climate(dem, {}, at, silent_progress());
  ClassRuleParameters parameters;
  parameters.seed = 7;
  parameters.climate = make_map_climate(dem, climate, {});
  return apply_class_rules(read_class_rules("life_zones"), parameters, dem, silent_progress())
      .classes.cells;
}

using ClassCounts = std::array<int, land_cover_class_count>;
inline ClassCounts count_classes(const Grid<LandCoverClass>& classes) {
  ClassCounts counts{};
  for (const LandCoverClass id : classes) ++counts[static_cast<std::size_t>(id)];
  return counts;
}

}  // namespace belvedere::test
