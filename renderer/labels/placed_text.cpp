#include "renderer/labels/placed_text.h"

#include <utility>

namespace belvedere {

std::vector<PlacedLetter> place_letters(const DrawnText& text, const TextMeasure& measure) {
  std::vector<PlacedLetter> placed;
  std::vector<double> widths;
  double width = 0.0;
  for (TextLetter& letter : measure.letters(text.text, text.type)) {
    widths.push_back(letter.width_px);
    width += letter.width_px;
    placed.push_back({.letter = std::move(letter)});
  }
  if (text.along.empty()) {
    double x = text.at.x - text.anchor * width;
    for (PlacedLetter& letter : placed) {
      letter.at = {x, text.at.y};
      x += letter.letter.width_px;
    }
    return placed;
  }
  const std::vector<LetterPosition> bent = set_along(widths, text.along);
  if (bent.empty()) return {};
  for (std::size_t i = 0; i < placed.size(); ++i) {
    placed[i].tangent = bent[i].tangent;
    placed[i].at = bent[i].at - .5 * widths[i] * bent[i].tangent;
  }
  return placed;
}

Outline outline_of(const std::vector<PlacedLetter>& letters) {
  Outline outline;
  for (const PlacedLetter& letter : letters)
    for (OutlineStep step : letter.letter.outline) {
      for (int i = 0; i < points_of(step.kind); ++i) {
        glm::dvec2& p = step.points[static_cast<std::size_t>(i)];
        p = letter.at + p.x * letter.tangent +
            p.y * glm::dvec2(-letter.tangent.y, letter.tangent.x);
      }
      outline.push_back(step);
    }
  return outline;
}

}  // namespace belvedere
