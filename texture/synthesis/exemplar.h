#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "base/grid.h"
#include "texture/synthesis/guide_stack.h"

namespace belvedere {

// 8-bit encoded sRGB, in which patches are compared. Only replay reads the painting at full depth.
using Rgb8 = std::array<std::uint8_t, 3>;
// An encoded colour, 0…1, to the nearest of 256 steps.
Rgb8 to_rgb8(glm::vec3 encoded);

// A picture with its guides, ready for copying.
struct Exemplar {
  static constexpr int largest_side = 32767;  // texels

  std::string name;
  Grid<Rgb8> picture;
  GuideStack guides;  // label 255: never a source (lettering, frames, excluded areas); depth:
                      // no piece is copied across its jumps
};

// Throws Error(usage) if picture and guides differ in size or are empty, Error(limit) over the
// largest side.
void check_exemplar(const Exemplar& exemplar);

}  // namespace belvedere
