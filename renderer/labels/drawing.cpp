#include "renderer/labels/drawing.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace belvedere {

glm::dvec2 point_at(const std::vector<glm::dvec2>& line, double from_start) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double piece = glm::length(line[i + 1] - line[i]);
    if (from_start <= piece || i + 2 == line.size())
      return piece > 0.0 ? line[i] + (line[i + 1] - line[i]) * (from_start / piece) : line[i];
    from_start -= piece;
  }
  return line.back();
}

void move_shape(DrawnShape& shape, glm::dvec2 by) {
  if (DrawnPath* path = std::get_if<DrawnPath>(&shape))
    for (glm::dvec2& p : path->points) p += by;
  if (DrawnCircle* circle = std::get_if<DrawnCircle>(&shape)) circle->centre += by;
  if (DrawnText* text = std::get_if<DrawnText>(&shape)) {
    text->at += by;
    for (glm::dvec2& p : text->along) p += by;
  }
}

double length_of(const std::vector<glm::dvec2>& line) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length += glm::length(line[i + 1] - line[i]);
  return length;
}

std::vector<LetterPosition> set_along(const std::vector<double>& widths_px,
                                      const std::vector<glm::dvec2>& line) {
  double all = 0.0;
  for (const double width : widths_px) all += width;
  double from = .5 * (length_of(line) - all);
  if (line.size() < 2 || from < 0.0) return {};
  std::vector<LetterPosition> positions;
  for (const double width : widths_px) {
    const glm::dvec2 centre = point_at(line, from + .5 * width);
    const double reach = std::max(.5, .5 * width);
    const glm::dvec2 chord = point_at(line, from + .5 * width + reach) -
                             point_at(line, std::max(0.0, from + .5 * width - reach));
    const double length = glm::length(chord);
    positions.push_back({centre, length > 0.0 ? chord / length : glm::dvec2(1.0, 0.0)});
    from += width;
  }
  return positions;
}

}  // namespace belvedere
