#pragma once

#include <cstdint>

#include "base/grid.h"

namespace belvedere {

// A pixel of a mask that belongs to nothing.
inline constexpr std::uint8_t no_label = 255;

// Gaussian mean of `values` over the texels around that have the same label: nothing passes from
// one class to another. Texels of no_label get 0. sigma in texels, > 0.
Grid<float> blur_within_labels(const Grid<float>& values, const Grid<std::uint8_t>& labels,
                               double sigma);

}  // namespace belvedere
