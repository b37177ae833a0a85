#pragma once

#include "base/grid.h"

namespace belvedere {

// Takes the change A' - A back to 0 in cells of `keep` != 0, takes little of it beside them and leaves all of it farther off. There is
// at least one such cell.
void settle_around_lakes(Grid<float>& change, const Grid<unsigned char>& keep);

}  // namespace belvedere
