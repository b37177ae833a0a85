#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"

namespace belvedere {

// Cast shadow of a painting of which only picture (encoded sRGB) and labels are known, as the guide of that name: 0 in shadow … 1 lit.
// What is larger than strokes (sigma stroke_px) of a label falls into two groups, dark and light (Otsu's threshold on lightness and
// blueness in OKLab); the dark one is shadow where it is clearly darker and bluer than the light one, else the whole label is lit: deep
// green woods are dark, not shaded. Texels of unused_label are lit.
Grid<float> find_shadow(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels, double stroke_px);

// From this on a texel counts as lying in the sun.
inline constexpr float lit_from = 0.5F;

}  // namespace belvedere
