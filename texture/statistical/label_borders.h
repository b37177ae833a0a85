#pragma once

#include <cstdint>

#include "base/grid.h"
#include "base/masks/label_blur.h"

namespace belvedere {

// 1 within `px` pixels, along rows and columns, of a pixel that is not 0.
Grid<std::uint8_t> widened(const Grid<std::uint8_t>& mask, int px);

// 1 for pixels within px pixels of a border of two labels, on either side (no_label has none); px =
// 1: those with a neighbour of another label.
Grid<std::uint8_t> near_borders(const Grid<std::uint8_t>& labels, int px);

}  // namespace belvedere
