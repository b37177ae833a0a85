#pragma once

#include <cstdint>

#include "base/grid.h"

namespace belvedere {

// Completes the sky of a mask with inferred classes, whose colour alone misleads:
// - A mask without sky gets one: the part along the upper edge, if it covers most of that edge and
//   lies in the upper half (a night sky, dark and rough).
// - Parts that sky surrounds (clouds, stars, the moon) become sky: those of whose outline at least
//   three quarters border on sky. The edges of the picture do not count.
Grid<std::uint8_t> complete_sky(Grid<std::uint8_t> mask);

}  // namespace belvedere
