#pragma once

#include "base/grid.h"

namespace belvedere {

// Reduces the change A' - A to 0 in cells of `keep` != 0, to little next to them, and keeps all of
// it farther away. There is at least one such cell.
void settle_around_lakes(Grid<float>& change, const Grid<unsigned char>& keep);

}  // namespace belvedere
