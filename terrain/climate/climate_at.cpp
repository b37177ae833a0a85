#include <algorithm>
#include <cmath>

#include "terrain/climate/climate.h"

namespace belvedere {
namespace {

void add(PlaceClimate& sum, const PlaceClimate& other, double weight) {
  for (std::size_t m = 0; m < sum.sea_level_c.size(); ++m) {
    sum.sea_level_c[m] += weight * other.sea_level_c[m];
    sum.lapse_k_per_km[m] += weight * other.lapse_k_per_km[m];
  }
  for (std::size_t km = 0; km < sum.rain_mm_at_km.size(); ++km)
    sum.rain_mm_at_km[km] += weight * other.rain_mm_at_km[km];
  sum.summer_share += weight * other.summer_share;
  sum.gathers += weight * other.gathers;
  sum.dry_air += weight * other.dry_air;
  sum.sheltered += weight * other.sheltered;
}

// The two neighbours of a position on a line of `count` values, and the weight of the second.
struct Neighbours {
  int first, second;
  double share;
};
Neighbours neighbours_at(double at, int count) {
  const double inside = std::clamp(at, 0.0, static_cast<double>(count - 1));
  const int first = std::min(static_cast<int>(inside), std::max(0, count - 2));
  return {first, std::min(first + 1, count - 1), inside - first};
}

}  // namespace

double Climate::on_coarse_grid(const Grid<float>& grid, double column, double row) const {
  const Neighbours x = neighbours_at((column + 0.5) / coarse_cells - 0.5, grid.width());
  const Neighbours y = neighbours_at((row + 0.5) / coarse_cells - 0.5, grid.height());
  const auto line = [&](int at) {
    return static_cast<double>(grid(x.first, at)) * (1.0 - x.share) +
           static_cast<double>(grid(x.second, at)) * x.share;
  };
  return line(y.first) * (1.0 - y.share) + line(y.second) * y.share;
}

PlaceClimate Climate::at(double column, double row) const {
  const Neighbours x =
      neighbours_at(position.width > 1 ? column / (position.width - 1) * (nodes.width() - 1) : 0.0,
                    nodes.width());
  const Neighbours y =
      neighbours_at(position.height > 1 ? row / (position.height - 1) * (nodes.height() - 1) : 0.0,
                    nodes.height());
  PlaceClimate here{.sea_level_c = {},
                    .lapse_k_per_km = {},
                    .rain_mm_at_km = {},
                    .summer_share = 0.0,
                    .gathers = 0.0};
  add(here, nodes(x.first, y.first), (1.0 - x.share) * (1.0 - y.share));
  add(here, nodes(x.second, y.first), x.share * (1.0 - y.share));
  add(here, nodes(x.first, y.second), (1.0 - x.share) * y.share);
  add(here, nodes(x.second, y.second), x.share * y.share);
  for (std::size_t m = 0; m < warmer_k.size(); ++m)
    if (!warmer_k[m].empty()) here.sea_level_c[m] += on_coarse_grid(warmer_k[m], column, row);
  if (!rain_share.empty()) {
    const double share = on_coarse_grid(rain_share, column, row);
    for (double& mm : here.rain_mm_at_km) mm *= share;
  }
  return here;
}

double usual_wind_from_deg(double latitude_deg) {
  constexpr double trades_to_deg = 30.0;
  constexpr double westerlies_to_deg = 65.0;
  const double away = std::abs(latitude_deg);
  return away >= trades_to_deg && away < westerlies_to_deg ? 270.0 : 90.0;
}

}  // namespace belvedere
