#include "terrain/cover/ground_lakes.h"

#include <algorithm>
#include <cstddef>

#include "terrain/shape/hole_lakes.h"

namespace belvedere {
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

}  // namespace belvedere
