#pragma once

#include "texture/synthesis/synth_state.h"

namespace belvedere::synth {

// Moves pieces over the cap, cell by cell of one colour, as a whole elsewhere. False where there is no such piece. Needs and leaves
// up-to-date pieces.
bool replace_pieces(LevelState& state, int pass, int round);
// What prices leave open, made certain at the end: no texel is used too often, no piece is larger than the cap, none runs on across a
// silhouette. Needs and leaves up-to-date pieces.
void finish_pieces(LevelState& state);

}  // namespace belvedere::synth
