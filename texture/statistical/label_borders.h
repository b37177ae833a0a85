#pragma once

#include <cstdint>

#include "base/grid.h"

namespace belvedere {

inline constexpr std::uint8_t no_label = 255;  // not known: has no borders

// 1 within `px` pixels, rows and columns alike, of one that is not 0.
Grid<std::uint8_t> widened(const Grid<std::uint8_t>& mask, int px);

// 1 for pixels that are at most the px-th off a border of two labels, to either side; 1: those that have a neighbour of another label.
Grid<std::uint8_t> near_borders(const Grid<std::uint8_t>& labels, int px);

}  // namespace belvedere
