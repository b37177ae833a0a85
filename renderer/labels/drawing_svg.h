#pragma once

#include <string>
#include <vector>

#include "renderer/labels/drawing.h"

namespace belvedere {

// The shapes as elements of SVG 1.1, one a line: text as text. On bent baselines each letter is an element of text of its own, turned to
// its place, in a group whose title is the text in one piece, because some programs (librsvg, converters to PDF) leave out what a textPath
// holds; scripts whose letters look another way alone than beside their neighbours (Arabic) become one outline there.
std::string shapes_svg(const std::vector<DrawnShape>& shapes);
// A whole file whose sheet is so wide.
std::string drawing_svg(const Drawing& drawing, double width_mm);

}  // namespace belvedere
