#include "renderer/trace/ground_surroundings.h"

#include "base/math_exact.h"
#include "base/parallel.h"
#include "renderer/trace/terrain_rim.h"
#include "terrain/shape/derivatives.h"

namespace belvedere {
namespace {

// A logarithm, because areas range from a cell to a province, and a picture can distinguish a rill
// from a brook, not 500 km² from 501. Rivers that enter at the edge begin there.
Grid<float> log_upstream_area(Grid<float> area) {
  constexpr double m2_per_km2 = 1e6;
  parallel_rows(area.height(), [&](int y) {
    for (int x = 0; x < area.width(); ++x)
      area(x, y) = static_cast<float>(exact::log10(m2_per_km2 * static_cast<double>(area(x, y))));
  });
  return area;
}

}  // namespace

GroundSurroundings find_surroundings(const Dem& dem, const LandCover& land_cover,
                                     Catchments* catchments) {
  GroundSurroundings found;
  found.valley_height_m = height_above_valley(dem.altitude_m, dem.cell_m(), 900.0);
  found.rim_m = rim_distance(dem);
  Catchments own(dem);
  found.flow = log_upstream_area((catchments != nullptr ? *catchments : own).take_km2());
  found.floor_plan = plan_floor(land_cover, dem);
  return found;
}

}  // namespace belvedere
