#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "renderer/labels/drawing.h"
#include "renderer/labels/text_measure.h"

namespace belvedere {

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
