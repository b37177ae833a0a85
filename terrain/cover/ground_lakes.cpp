#include "terrain/cover/ground_lakes.h"

#include <algorithm>
#include <cstddef>

#include "terrain/shape/hole_lakes.h"

namespace belvedere {
namespace {

// Lakes are as large on coarser cells as on those of the data, down to what still is a patch and no speck.
int lake_cells(int data_cells, int halved) {
  constexpr int least = 25;
  return halved == 0 ? data_cells : std::max(std::min(data_cells, least), data_cells >> (2 * halved));
}

}  // namespace

Grid<std::uint8_t> ground_lakes(const Dem& dem, LakeParameters parameters, const Sea& sea, const Grid<std::uint8_t>& known) {
  parameters.min_cells = lake_cells(parameters.min_cells, dem.halved);
  Grid<std::uint8_t> mask = find_lakes(dem.altitude_m, parameters);
  const Grid<std::uint8_t> holes = find_hole_lakes(dem, parameters.min_cells, known);
  for (std::size_t i = 0; i < mask.size(); ++i)
    mask[i] = static_cast<std::uint8_t>(!sea.empty() && sea.mask[i] != 0 ? 0 : mask[i] | holes[i]);
  return mask;
}

}  // namespace belvedere
