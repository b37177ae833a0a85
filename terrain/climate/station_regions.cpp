#include "terrain/climate/station_regions.h"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>

#include "base/math.h"

namespace belvedere {
namespace {

constexpr double min_region_relief_m = 100.0;  // of a region's stations; less gives no rate

bool has_own_rates(const std::vector<Station>& stations) {
  if (stations.size() < static_cast<std::size_t>(fewest_stations)) return false;
  const auto [low, high] = std::minmax_element(
      stations.begin(), stations.end(),
      [](const Station& a, const Station& b) { return a.altitude_m < b.altitude_m; });
  return high->altitude_m - low->altitude_m >= min_region_relief_m;
}

}  // namespace

std::vector<StationRegion> station_regions(const std::vector<Station>& stations,
                                           bool (*known)(const Station&)) {
  std::vector<StationRegion> regions;
  std::vector<Station> all;
  for (const Station& station : stations) {
    auto region = std::find_if(regions.begin(), regions.end(), [&](const StationRegion& one) {
      return one.name == station.region;
    });
    if (region == regions.end()) {
      regions.push_back({.name = station.region, .stations = {}});
      region = regions.end() - 1;
    }
    region->at.push_back(station.position);
    if (!known(station)) continue;
    region->stations.push_back(station);
    all.push_back(station);
  }
  for (StationRegion& region : regions) {
    region.is_own = regions.size() == 1 || has_own_rates(region.stations);
    if (!region.is_own) region.stations = all;
  }
  return regions;
}

std::vector<double> region_weights(const std::vector<StationRegion>& regions, glm::dvec2 position) {
  if (regions.size() == 1) return {1.0};
  constexpr double beside_m = 1.0;  // keeps the ratio of distances finite at a station
  std::vector<double> away_m;
  for (const StationRegion& region : regions) {
    double nearest_m = std::numeric_limits<double>::max();
    for (const glm::dvec2& at : region.at)
      nearest_m = std::min(nearest_m, glm::distance(at, position));
    away_m.push_back(beside_m + nearest_m);
  }
  const double nearest_m = *std::min_element(away_m.begin(), away_m.end());
  std::vector<double> weights;
  double sum = 0.0;
  for (const double m : away_m) {
    weights.push_back(smoothstep(2.0 * nearest_m / m - 1.0));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

}  // namespace belvedere
