#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "texture/synthesis/synth_state.h"

namespace belvedere::synth {

// Matches to begin with: one pick a pixel.
void start_from_picks(LevelState& state);
// Or the coarser level's, twice as large; where its class is wrong a neighbouring parent's, extended; else a pick.
void start_from_coarser(LevelState& state, const Plane& coarse_exemplars, const Plane& coarse_target,
                        const std::vector<std::uint32_t>& coarse_match);
// Counts uses and bins and copies colours for matches just set, where no uses were counted before; the start_ functions end with it.
void count_matches(LevelState& state);
// The same whatever was counted before.
void recount(LevelState& state);
// Sets the uses of all texels that are matched to 0, so that another window can be counted, without a look at the others.
void forget_uses_of(LevelState& state);

// One sub-pass: the pixels whose x and y have these parities look at the state before it and move at once.
void sub_pass(LevelState& state, int pass, int odd_x, int odd_y);
// All passes of the level. progress.advance(1) after each.
void improve(LevelState& state, Progress& progress);

}  // namespace belvedere::synth
