#pragma once

#include <array>
#include <cstdint>

#include "base/grid.h"
#include "base/progress.h"

namespace belvedere {

// Labels whose areas are peeled level by level, as snow melts back and forest retreats (Zalesny, Ferrari, Caenen, Van Gool, "Composite
// Texture Synthesis", 2005, section 7: masks of one texture give way to those around).
struct ErosionParameters {
  int levels = 1;      // how often a layer is taken off, 1…255
  double step = 8.0;   // thickness of a layer in the mean, in the unit of `cell`; 0.5 cells and more
  double cell = 1.0;   // side of a cell
  double ragged = .4;  // how far slow and fast places of the ground differ, 0…1; 0: none do
  std::uint64_t seed = 1;
  // Place of the first cell's middle and the way to the next column and row, in the unit of `cell`: slow and fast places hang on it, so
  // that grids that show the same ground erode alike.
  double x = 0.0;
  double y = 0.0;
  double dx = 1.0;
  double dy = 1.0;
};

struct Erosion {
  Grid<std::uint8_t> labels;  // each cell that was taken has the label that took it
  Grid<std::uint8_t> level;   // at which it was taken, 1…levels; 0: it was not
};

// Takes `label` back from every cell of a label that `opens`: those cells keep theirs. A layer is what a front reaches that sets out from
// there all at once and takes its time by the ground: longer where noise of four and of 1.2 layers' width says so and where much of the
// label still stands around, so that tongues and islands go before bays. A flat border goes back by a step a level in the mean. What a
// front took belongs to the nearest label in its time (ties: to the lower one). Each level is taken from what the one before left: levels
// are nested. Integers decide, so a cell's answer is the same in any part of the grid that holds erosion_reach around it.
// Progress: one step a level.
Erosion erode(const Grid<std::uint8_t>& labels, std::uint8_t label, const std::array<bool, 256>& opens, const ErosionParameters& parameters,
              Progress& progress = silent_progress());

// Cells around a cell that can matter to it.
int erosion_reach(const ErosionParameters& parameters);

}  // namespace belvedere
