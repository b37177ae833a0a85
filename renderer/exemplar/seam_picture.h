#pragma once

#include <cstdint>

#include "base/grid.h"
#include "renderer/paint/composite.h"

namespace belvedere {

// What synthesis compares: the part of a painting that the residual carries over, picture -
// residual · base, because a seam shows where that part jumps and not where light does. Each label
// is stretched to the same contrast about mid grey: otherwise low-contrast strokes would be torn
// apart to satisfy guides.
Grid<Rgb8> seam_picture(const PaintedExemplar& painted, const Grid<std::uint8_t>& labels,
                        double residual);

}  // namespace belvedere
