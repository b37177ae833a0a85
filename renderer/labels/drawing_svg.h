#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "renderer/labels/drawing.h"
#include "renderer/labels/text_measure.h"

namespace belvedere {

// The shapes as elements of SVG 1.1, one per line: text as text. On curved baselines each letter is
// its own text element, rotated in place, in a group whose title is the whole text, because some
// programs (librsvg, converters to PDF) omit textPath; scripts whose letters change shape beside
// their neighbours (Arabic) become one outline there.
std::string shapes_svg(const std::vector<DrawnShape>& shapes);
// A whole file for a sheet of that width.
std::string drawing_svg(const Drawing& drawing, double width_mm);

// A letter of a text and its position on the sheet.
struct PlacedLetter {
  TextLetter letter;
  glm::dvec2 at{0.0};            // the left end of its width, on the baseline
  glm::dvec2 tangent{1.0, 0.0};  // of its baseline, of length 1
};

// The letters of a text, from left to right; none where a curved baseline is shorter than they are.
std::vector<PlacedLetter> place_letters(const DrawnText& text, const TextMeasure& measure);
// All of them as one outline, px of the sheet.
Outline outline_of(const std::vector<PlacedLetter>& letters);

}  // namespace belvedere
