#pragma once

#include "renderer/paint/water/water_surface.h"

namespace belvedere::test {

inline constexpr Patches no_noise{0.0F, 0.0F, 0.0F, 0.0F};

}  // namespace belvedere::test
