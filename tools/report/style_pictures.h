#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "base/grid.h"
#include "renderer/style/style.h"

namespace belvedere::tools {

// Pictures of a style's contents, encoded sRGB; a pixel of the painting is `zoom` pixels wide.

// Strokes of a class at random positions over its colours from shadow (left) to light (right), with
// its lengths, widths, residuals and directions. Sky: over its gradient from top to bottom.
Grid<glm::vec3> stroke_swatch(const Style& style, LandCoverClass id, int width_px, int height_px,
                              int zoom);
// The ramp of a class from shadow to light, half a picture high, and the reference's below it.
Grid<glm::vec3> ramp_swatch(const Palette& palette, const Palette& reference, LandCoverClass id,
                            int width_px, int height_px);
// The medians of a sky, interpolated linearly, plus its two components as noise of their lengths.
Grid<glm::vec3> sky_swatch(const StyleSky& sky, int width_px, int height_px);
// A mask in the colours of class maps; distant haze is pale, unused pixels are near black.
Grid<glm::vec3> class_picture(const Grid<std::uint8_t>& mask);
// The part of the painting of that size with the most pixels of a class, enlarged; nothing where
// the class is too small.
std::optional<Grid<glm::vec3>> class_crop(const Grid<glm::vec3>& painting,
                                          const Grid<std::uint8_t>& mask, LandCoverClass id,
                                          int width_px, int height_px, int zoom);

// Writes the result of `style fit` as a page with pictures, in a folder that can be moved and read
// offline: the painting and its classes, the colours of each class compared with the reference's
// and its strokes with the painting's, sky, air, what was derived and from what. Throws
// Error(output).
void write_style_page(const std::string& folder, const std::string& painting_name,
                      const Grid<glm::vec3>& painting, const Grid<std::uint8_t>& mask,
                      const Style& style, const Palette& reference, const std::string& command);

}  // namespace belvedere::tools
