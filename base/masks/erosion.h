#pragma once

#include <array>
#include <cstdint>

#include "base/grid.h"
#include "base/progress.h"

namespace belvedere {

// Erodes the areas of labels level by level, as snow melts back and forest retreats (Zalesny,
// Ferrari, Caenen, Van Gool, "Composite Texture Synthesis", 2005, section 7: masks of one texture
// give way to neighbouring ones).
struct ErosionParameters {
  int levels = 1;      // number of layers to remove, 1…255
  double step = 8.0;   // average thickness of a layer in the unit of `cell`; at least 0.5 cells
  double cell = 1.0;   // side of a cell
  double ragged = .4;  // difference between slow and fast ground, 0…1; 0: uniform
  std::uint64_t seed = 1;
  // Centre of the first cell and the vectors to the next column and row, in the unit of `cell`.
  // Slow and fast positions depend on it, so that grids of the same ground erode alike.
  double x = 0.0;
  double y = 0.0;
  double dx = 1.0;
  double dy = 1.0;
};

struct Erosion {
  Grid<std::uint8_t> labels;  // with each eroded cell set to the label that replaced it
  Grid<std::uint8_t> level;   // at which it was eroded, 1…levels; 0: it was not
};

// Erodes `label` from every cell of a label that `opens`; those cells keep their labels. A layer is
// the area that a front reaches from all of them at once. The front is slower where noise with
// widths of four and of 1.2 layers is high and where much of the label remains around, so tongues
// and islands disappear before bays. A flat border recedes by one step per level on average. An
// eroded cell gets the label that reaches it first (ties: the lower one). Each level starts from
// the result of the previous one, so levels are nested. Arithmetic is in integers, so a cell's
// result is the same in any part of the grid that includes erosion_reach around it. Progress: one
// step per level.
Erosion erode(const Grid<std::uint8_t>& labels, std::uint8_t label,
              const std::array<bool, 256>& opens, const ErosionParameters& parameters,
              Progress& progress = silent_progress());

// Radius in cells of the neighbourhood that can affect a cell.
int erosion_reach(const ErosionParameters& parameters);

}  // namespace belvedere
