#pragma once

#include "base/grid.h"

namespace belvedere {

// Reduces the change A' - A to 0 in cells of `keep` != 0, to little next to them, and keeps all of
// it farther away: what remains at their border fades in over fade_cells. Shores are short; across
// the edge of a mask, where the ground goes on, the change must not show.
constexpr float shore_fade_cells = 6.0F;
constexpr float mask_fade_cells = 16.0F;
// Lengths are in cells of the data; halved: number of halvings from the data to these cells.
void settle_around_kept(Grid<float>& change, const Grid<unsigned char>& keep, float fade_cells,
                        int halved = 0);

}  // namespace belvedere
