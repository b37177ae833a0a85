#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "renderer/paint/palette.h"

namespace belvedere {

// A colour of a palette and its printed colour.
struct PaletteColour {
  std::string where;     // "forest at 1200 m, tone .34", "haze_far"
  glm::vec3 colour;      // encoded sRGB
  glm::vec3 printed;     // the nearest printable colour, encoded sRGB clamped to 0…1
  double delta_e = 0.0;  // ΔE2000 between the two
};
// Every colour of the palette, in its order: ramps by class and altitude, sky, clouds, haze,
// leaves. A picture's colours lie between them, or beside them through light and air.
std::vector<PaletteColour> print_palette(const Palette& palette,
                                         const std::vector<std::uint8_t>& press);

}  // namespace belvedere
