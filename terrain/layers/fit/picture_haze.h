#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"

namespace belvedere {

// Light that air scatters into a picture from above: most in blue, and more over low ground, since
// more air lies above it.
struct PictureHaze {
  glm::dvec3 at_sea_level{0.0};  // 0…255, of red, green and blue
};

// The haze by dark objects (Chavez 1988): the darkest fiftieth of the cells of each of twelve bands
// of altitude would be neutral without it, so the excess of their blue over red is haze, which
// decreases with the fourth power of the wavelength and by e every 8 km of altitude. The median of
// the bands; 0 if dark cells are not blue. `use`: 0 for cells to skip.
PictureHaze find_haze(const Grid<glm::vec3>& picture, const Grid<float>& altitude_m,
                      const Grid<std::uint8_t>& use);
// The picture without it, 0…255.
Grid<glm::vec3> without_haze(const Grid<glm::vec3>& picture, const Grid<float>& altitude_m,
                             const PictureHaze& haze);

}  // namespace belvedere
