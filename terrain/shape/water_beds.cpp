#include "terrain/shape/water_beds.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

// Radius around the nearest shore for the bank's slope: the cells next to a lake are often as level
// as the lake.
constexpr int bank_cells = 6;

// Metres between a cell and one of an index.
double way_m(const Dem& dem, int x, int y, std::int32_t to) {
  return exact::hypot((to % dem.width() - x) * dem.transform.cell_x,
                      (to / dem.width() - y) * dem.transform.cell_y);
}

// Rise over run of the land around a cell of the shore.
double bank_slope(const Dem& dem, const Grid<std::uint8_t>& water,
                  const Grid<std::int32_t>& nearest_water, std::int32_t shore,
                  const WaterBedParameters& p) {
  const double half_cell_m = 0.5 * dem.cell_m();
  const int x0 = shore % dem.width();
  const int y0 = shore / dem.width();
  double rise = 0.0;
  double run = 0.0;
  for (int y = y0 - bank_cells; y <= y0 + bank_cells; ++y)
    for (int x = x0 - bank_cells; x <= x0 + bank_cells; ++x) {
      if (!water.contains(x, y) || water(x, y) != 0) continue;
      const std::int32_t from = nearest_water(x, y);
      if (from < 0) continue;
      rise += static_cast<double>(dem.altitude_m(x, y)) -
              static_cast<double>(dem.altitude_m[static_cast<std::size_t>(from)]);
      run += way_m(dem, x, y, from) - half_cell_m;
    }
  return run > 0.0 ? std::clamp(rise / run, p.flattest_bank, p.steepest_bank) : p.flattest_bank;
}

}  // namespace

WaterBeds make_water_beds(const Grid<std::uint8_t>& water, const Dem& dem,
                          const WaterBedParameters& p) {
  if (!water.same_size(dem.altitude_m))
    throw Error(ErrorKind::bug, "beds of water", "the mask and the DEM differ in size");
  const int width = dem.width();
  const int height = dem.height();
  const double half_cell_m = 0.5 * dem.cell_m();
  Grid<std::uint8_t> land(width, height);
  for (std::size_t i = 0; i < land.size(); ++i) land[i] = water[i] == 0 ? 1 : 0;
  const Grid<std::int32_t> nearest_land = nearest_marked(land);
  const Grid<std::int32_t> nearest_water = nearest_marked(water);

  WaterBeds beds{Grid<float>(width, height, 0.0F), Grid<float>(width, height, 0.0F)};
  // Broad water is a lake, and so is water within half a river's width of it.
  const double broad_m = std::max(0.5 * p.river_width_m, 2.0 * half_cell_m);
  Grid<std::uint8_t> broad(width, height, 0);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      if (water(x, y) == 0) continue;
      const std::int32_t shore = nearest_land(x, y);
      if (shore < 0) {  // water everywhere
        broad(x, y) = 1;
        beds.depth_m(x, y) = static_cast<float>(p.deepest_m);
        continue;
      }
      const double off_m = std::max(way_m(dem, x, y, shore) - half_cell_m, 0.0);
      broad(x, y) = off_m >= broad_m ? 1 : 0;
      const double slope = bank_slope(dem, water, nearest_water, shore, p);
      beds.depth_m(x, y) =
          static_cast<float>(p.deepest_m * (1.0 - exact::exp(-slope * off_m / p.deepest_m)));
    }
  });
  const Grid<std::int32_t> nearest_broad = nearest_marked(broad);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::int32_t centre = nearest_broad(x, y);
      if (water(x, y) == 0 || centre < 0) continue;
      const double beyond_m = way_m(dem, x, y, centre) - broad_m - half_cell_m;
      beds.lake(x, y) = static_cast<float>(1.0 - smoothstep(0.0, p.river_width_m, beyond_m));
    }
  });
  return beds;
}

}  // namespace belvedere
