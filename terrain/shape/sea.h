#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "terrain/io/dem.h"

namespace belvedere {

// The sea in a DEM: level ground at about 0 m that reaches the edge of the data or a hole in it, and what lies lower and is connected with
// it. Ground below 0 m inland (behind dikes, in basins without a way to the sea) is land. docs/class_rules.md.

struct Sea;

struct SeaParameters {
  bool look = true;  // false: there is none
  // Where the sea stands, m; then all ground from there down that is connected with the edge of the data is sea, level or not, as where
  // the DEM knows the sea's bed. Empty: found as the level that most level ground by the edge has, within 1.5 m of 0.
  std::optional<double> level_m = {};
  int least_cells = 400;  // > 0: of level sea in one piece
  // Of a window of a larger DEM: its sea, as continue_sea() has it from the whole. Then nothing is looked for.
  std::shared_ptr<const Sea> known = {};
};

struct Sea {
  Grid<std::uint8_t> mask;  // 1 sea, 0 land, as large as the DEM; empty where there is no sea
  double level_m = 0.0;
  double noise_m = 0.0;  // how far the DEM's sea strays from its level: 95 of 100 cells by less
  double share = 0.0;    // 0…1 of all cells

  bool empty() const { return mask.empty(); }
};

// Robust against noise of ± 2 m on the water and against holes in the data over it: a hole (filled or not) is sea where it touches the
// edge or level sea, and at least a quarter of the ground around it lies no higher than the shore. Same bits for any number of threads;
// memory: 24 bytes a cell.
Sea find_sea(const Dem& dem, const SeaParameters& parameters = {});

// The sea of `whole` in a window of its terrain with finer cells: at the whole's level, where the whole has sea and what is no higher, and
// from there on through low ground of the window. Level ground that touches the window's rim is no sea by that: the rim is no edge of the
// data.
Sea continue_sea(const Dem& window, const Dem& whole, const Sea& sea, const SeaParameters& parameters = {});

// Level water: what is sea gets the sea's level, and holes there are no holes any more.
void level_sea(Dem& dem, const Sea& sea);

}  // namespace belvedere
