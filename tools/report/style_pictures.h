#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "base/grid.h"
#include "renderer/style/style.h"

namespace belvedere::tools {

// Pictures of what a style says, encoded sRGB; a pixel of the painting is `zoom` pixels.

// Strokes of a class, thrown at random over its colours from shadow (left) to light (right), with
// its lengths, widths, residuals and how level they lie. Sky: over its gradient from top to bottom.
Grid<glm::vec3> stroke_swatch(const Style& style, LandCoverClass id, int width_px, int height_px,
                              int zoom);
// The ramp of a class from shadow to light, half a picture high, and the reference's below it.
Grid<glm::vec3> ramp_swatch(const Palette& palette, const Palette& reference, LandCoverClass id,
                            int width_px, int height_px);
// The medians of a sky, linear between them, with its two changes as waves of their lengths.
Grid<glm::vec3> sky_swatch(const StyleSky& sky, int width_px, int height_px);
// A mask in the colours of class maps; far air pale, unused near black.
Grid<glm::vec3> class_picture(const Grid<std::uint8_t>& mask);
// The part of the painting of that size that holds the most of a class, enlarged; nothing where
// there is too little of it.
std::optional<Grid<glm::vec3>> class_crop(const Grid<glm::vec3>& painting,
                                          const Grid<std::uint8_t>& mask, LandCoverClass id,
                                          int width_px, int height_px, int zoom);

}  // namespace belvedere::tools
