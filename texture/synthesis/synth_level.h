#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "texture/synthesis/synth_state.h"

namespace belvedere::synth {

// Initial matches: one pick per pixel.
void start_from_picks(LevelState& state);
// Initial matches from the coarser level, upsampled by two; if the class is wrong, that of a
// neighbouring parent, extended; else a pick.
void start_from_coarser(LevelState& state, const Plane& coarse_exemplars,
                        const Plane& coarse_target, const std::vector<std::uint32_t>& coarse_match);
// Counts uses and bins and copies colours for new matches, if no uses were counted before; the
// start_ functions end with it.
void count_matches(LevelState& state);
// Counts again, whatever was counted before.
void recount(LevelState& state);
// Sets the uses of all matched texels to 0, so that another window can be counted, without touching
// the others.
void forget_uses_of(LevelState& state);

// One sub-pass: the pixels whose x and y have these parities decide by the state before it and move
// together.
void sub_pass(LevelState& state, int pass, int odd_x, int odd_y);
// All passes of the level. progress.advance(1) after each.
void improve(LevelState& state, Progress& progress);

// Moves pieces over the cap as a whole elsewhere, cell by cell of one checkerboard colour. False if
// there is no such piece. Needs and leaves up-to-date pieces.
bool replace_pieces(LevelState& state, int pass, int round);
// Enforces what prices cannot guarantee: no texel is used too often, no piece is larger than the
// cap, none continues across a silhouette. Needs and leaves up-to-date pieces.
void finish_pieces(LevelState& state);

}  // namespace belvedere::synth
