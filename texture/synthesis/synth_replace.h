#pragma once

#include "texture/synthesis/synth_state.h"

namespace belvedere::synth {

// Moves pieces over the cap as a whole elsewhere, cell by cell of one checkerboard colour. False if
// there is no such piece. Needs and leaves up-to-date pieces.
bool replace_pieces(LevelState& state, int pass, int round);
// Enforces what prices cannot guarantee: no texel is used too often, no piece is larger than the
// cap, none continues across a silhouette. Needs and leaves up-to-date pieces.
void finish_pieces(LevelState& state);

}  // namespace belvedere::synth
