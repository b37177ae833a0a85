#pragma once

#include <cstdint>

#include "base/grid.h"

namespace belvedere {

// Value of mask pixels without a label.
inline constexpr std::uint8_t no_label = 255;

// Gaussian blur of `values` within each label: a mean over neighbouring texels of the same label
// only. Texels of no_label get 0. sigma in texels, > 0.
Grid<float> blur_within_labels(const Grid<float>& values, const Grid<std::uint8_t>& labels,
                               double sigma);

}  // namespace belvedere
