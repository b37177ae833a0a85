#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "terrain/climate/stations.h"

namespace belvedere {

// A homogeneous area of a table of stations, by its column `region`, with rates of its own.
struct StationRegion {
  std::string name;                 // empty: of the stations without one, or of a table without any
  std::vector<Station> stations;    // with a known value; all of the table's if `is_own` is false
  std::vector<glm::dvec2> at = {};  // of all stations of that name
  bool is_own = true;               // false: too few stations, or on one level, for its own rates
};

// The regions in the order of their first stations. `known`: whether a station has the value that
// is regressed.
std::vector<StationRegion> station_regions(const std::vector<Station>& stations,
                                           bool (*known)(const Station&));

// Weights of regions at a position, which sum to 1. A region has all of it where every other one is
// at least twice as far away, by their nearest stations; in between they blend smoothly. So
// stations have the rates of their own region.
std::vector<double> region_weights(const std::vector<StationRegion>& regions, glm::dvec2 position);

}  // namespace belvedere
