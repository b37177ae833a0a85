#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "renderer/base/grid.h"
#include "texture/guide_stack.h"

namespace belvedere {

// 8-bit encoded sRGB: what patches are compared in. The full-depth painting is only touched by replay.
using Rgb8 = std::array<std::uint8_t, 3>;

// A picture with its guides, ready to copy from. At most 32767 texels on a side.
struct Exemplar {
  std::string name;
  Grid<Rgb8> picture;
  GuideStack guides;           // label 255: never a source (lettering, frames, what a mask excludes)
};

}  // namespace belvedere
