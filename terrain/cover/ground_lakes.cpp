#include "terrain/cover/ground_lakes.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

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

}  // namespace belvedere
