#pragma once

#include <string>
#include <vector>

#include "base/grid.h"
#include "terrain/layers/fit/fit_measures.h"
#include "terrain/layers/fit/ground_fit.h"

namespace belvedere {

// Ground that is learned from and ground that judges: 0 … count - 1, the number of the part a cell is judged in.
struct HoldOut {
  std::string name;
  int parts = 0;
  Grid<std::uint8_t> part;  // of each cell
};
// A chessboard of squares, both ways: neighbouring squares look alike, so it flatters.
HoldOut chessboard(int width, int height, int square_cells = 64);
// West, east: what is learned must carry over to other ground.
HoldOut west_and_east(int width, int height);
HoldOut north_and_south(int width, int height);

// Each part predicted by what was learned on the others.
struct HeldOutResult {
  GroundPrediction prediction;  // shares and colours of each cell by a fit that has not seen it
  ClassMeasures measures;
  ClassMeasures matched;                     // with offsets that give each class the area it has on all of the ground
  std::vector<BlockDifference> differences;  // with a picture: of blocks of 1, 16, 32, 64 cells
  double gradient_share = 0.0;               // energy of the expected colours' gradients over the picture's
};
// Error(input) where a part leaves nothing to learn from.
HeldOutResult judge_held_out(const KnownGround& ground, const GroundFitParameters& parameters, const HoldOut& hold_out);

// As long as no input is asked: a class's share by the altitude's 32 bands. What every model must beat.
HeldOutResult judge_bands(const KnownGround& ground, const HoldOut& hold_out);

}  // namespace belvedere
