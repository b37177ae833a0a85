#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "base/grid.h"

namespace belvedere::tools {

// Text in pictures, in the system's plain font: Error(input) where no fonts are installed.
inline constexpr int text_height = 8;  // of capitals and descenders, px, at scale 1
// Width of the text in pixels.
int text_width(const std::string& text, int scale);
// `x`, `y`: the upper left corner of the first letter; parts outside the picture are cut off.
// Encoded sRGB.
void draw_text(Grid<glm::vec3>& picture, int x, int y, const std::string& text, glm::vec3 colour,
               int scale);

// Captions on sheets of pictures.
inline constexpr int caption_scale = 2;
inline constexpr int caption_line_px = text_height * caption_scale + 6;

}  // namespace belvedere::tools
