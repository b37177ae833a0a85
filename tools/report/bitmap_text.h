#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "base/grid.h"

namespace belvedere::tools {

// Words in pictures, drawn with letters of 5 × 8 dots that are part of the program: the same on every machine, with no font to be found.
// ASCII letters, digits and . , : - + = _ / ( ) %; anything else is a box, a character of several bytes one box.
inline constexpr int text_height = 8;  // dots, at scale 1
// Dots that the text is wide.
int text_width(const std::string& text, int scale);
// `x`, `y`: the upper left corner of the first letter; what lies outside of the picture is cut off.
void draw_text(Grid<glm::vec3>& picture, int x, int y, const std::string& text, glm::vec3 colour, int scale);

// Captions on sheets of pictures.
inline constexpr int caption_scale = 2;
inline constexpr int caption_line_px = text_height * caption_scale + 6;

}  // namespace belvedere::tools
