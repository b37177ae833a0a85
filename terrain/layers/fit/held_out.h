#pragma once

#include <string>
#include <vector>

#include "base/grid.h"
#include "terrain/layers/fit/fit_measures.h"
#include "terrain/layers/fit/ground_fit.h"

namespace belvedere {

// Cross-validation: a division of the ground into parts, each evaluated with a fit to the others. 0
// … count - 1, the number of the part of a cell.
struct HoldOut {
  std::string name;
  int parts = 0;
  Grid<std::uint8_t> part;  // of each cell
};
// A chessboard of squares: neighbouring squares are similar, so its result is optimistic.
HoldOut chessboard(int width, int height, int square_cells = 64);
// West, east: tests whether a fit transfers to other ground.
HoldOut west_and_east(int width, int height);
HoldOut north_and_south(int width, int height);

// Each part predicted by a fit to the others.
struct HeldOutResult {
  GroundPrediction prediction;  // shares and colours of each cell by a fit without it
  ClassMeasures measures;
  ClassMeasures matched;  // with offsets that give each class its area on the whole ground
  std::vector<BlockDifference> differences;  // with a picture: blocks of 1, 16, 32, 64 cells
  double gradient_share = 0.0;  // gradient energy of the expected colours over the picture's
};
// Error(input) if a part leaves nothing to learn from.
HeldOutResult evaluate_held_out(const KnownGround& ground, const GroundFitParameters& parameters,
                                const HoldOut& hold_out);

// Baseline without inputs: a class's share in 32 bands of altitude. Every model must be better.
HeldOutResult judge_bands(const KnownGround& ground, const HoldOut& hold_out);

}  // namespace belvedere
