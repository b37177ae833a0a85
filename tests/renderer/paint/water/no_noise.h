#pragma once

#include "renderer/paint/water_look.h"

namespace belvedere::test {

inline constexpr Patches no_noise{0.0F, 0.0F, 0.0F, 0.0F};

}  // namespace belvedere::test
