#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"

namespace belvedere {

// The light of a painting of which only picture (encoded sRGB) and labels are known, 0…1: lightness
// (OKLab) of structures larger than strokes (sigma stroke_px, never across a border of labels),
// ranked within each label and mapped to the distribution of tone in a target (quartiles .43 .64
// .86: docs/synthesis.md, Paintings from paper). A label of one flat colour has tone .64; texels of
// unused_label have 0.
Grid<float> estimate_tone(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels,
                          double stroke_px);

}  // namespace belvedere
