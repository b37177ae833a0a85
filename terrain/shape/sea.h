#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "terrain/io/dem.h"

namespace belvedere {

// The sea in a DEM: level ground at about 0 m that reaches the border of the data or a void in it,
// and lower ground connected with it. Ground below 0 m inland (behind dikes, in basins without an
// outlet to the sea) is land. See docs/class_rules.md.

struct Sea;

struct SeaParameters {
  bool look = true;  // false: there is no sea
  // Sea level, m; then all ground at or below it that is connected with the border of the data is
  // sea, level or not, as for a DEM with bathymetry. Empty: the most frequent level of level ground
  // at the border, within 1.5 m of 0.
  std::optional<double> level_m = {};
  int min_cells = 400;  // > 0: of level sea in one piece
  // For a window of a larger DEM: its sea, by continue_sea() from the whole. Then nothing is
  // searched.
  std::shared_ptr<const Sea> known = {};
};

struct Sea {
  Grid<std::uint8_t> mask;  // 1 sea, 0 land, as large as the DEM; empty if there is no sea
  double level_m = 0.0;
  double noise_m = 0.0;  // 95th percentile of the deviation of the DEM's sea from its level
  double share = 0.0;    // 0…1 of all cells

  bool empty() const { return mask.empty(); }
};

// Robust against noise of ± 2 m on the water and against voids over it: a void (filled or not) is
// sea if it touches the border or level sea, and at least a quarter of the ground around it is no
// higher than the shore. Same bits for any number of threads; memory: 24 bytes per cell.
Sea find_sea(const Dem& dem, const SeaParameters& parameters = {});

// The sea of `whole` in a window of its terrain with finer cells: cells at or below the whole's
// level where the whole has sea, extended through low ground of the window. Level ground at the
// window's border is not sea by itself, because that is not the border of the data.
Sea continue_sea(const Dem& window, const Dem& whole, const Sea& sea,
                 const SeaParameters& parameters = {});

// Levels the water: sea cells get the sea's level, and voids there are no longer voids.
void level_sea(Dem& dem, const Sea& sea);

}  // namespace belvedere
