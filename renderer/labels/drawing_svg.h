#pragma once

#include <string>
#include <vector>

#include "renderer/labels/drawing.h"

namespace belvedere {

// The shapes as elements of SVG 1.1, one per line: text as text. On curved baselines each letter is
// its own text element, rotated in place, in a group whose title is the whole text, because some
// programs (librsvg, converters to PDF) omit textPath; scripts whose letters change shape beside
// their neighbours (Arabic) become one outline there.
std::string shapes_svg(const std::vector<DrawnShape>& shapes);
// A whole file for a sheet of that width.
std::string drawing_svg(const Drawing& drawing, double width_mm);

}  // namespace belvedere
