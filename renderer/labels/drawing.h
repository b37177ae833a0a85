#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <variant>
#include <vector>

#include "renderer/labels/text_measure.h"

namespace belvedere {

// Vector shapes over a picture or beside it, in pixels of the sheet, x right, y down; colours
// "#rrggbb" (sRGB), empty: none. The same drawing becomes SVG (drawing_svg) and pixels
// (SheetPainter).

struct DrawnPath {
  std::vector<glm::dvec2> points;
  bool closed = false;
  std::string fill;
  std::string stroke;
  double width_px = 0.0;
  std::vector<double> dashes_px = {};  // dash pattern: on, off …; empty: solid
  double opacity = 1.0;                // of fill and stroke, 0…1
};

struct DrawnCircle {
  glm::dvec2 centre{0.0};
  double radius_px = 0.0;
  std::string fill;
  std::string stroke;
  double width_px = 0.0;
};

// A line of text on a level baseline, or, with `along`, on a curved one.
struct DrawnText {
  std::string text;
  TextStyle type;
  glm::dvec2 at{0.0};   // on the baseline
  double anchor = 0.0;  // anchor of the text: 0 its left end, .5 its centre, 1 its right end
  std::string colour;
  std::string halo = {};  // around the letters, where there is no picture below them
  double halo_px = 0.0;
  double halo_contrast = 0.0;  // > 0: in a picture the halo is the painting, changed until it has
                               // this contrast to the letters (paint_halo.h)
  std::vector<glm::dvec2> along =
      {};  // the baseline, from left to right; the text is centred on it
};

using DrawnShape = std::variant<DrawnPath, DrawnCircle, DrawnText>;

struct Drawing {
  glm::dvec2 size_px{0.0};
  std::vector<DrawnShape> shapes;  // the first is at the bottom
};

void move_shape(DrawnShape& shape, glm::dvec2 by);

// The centre of each letter on a curved baseline, and its rotation: the tangent of the line under
// its own width.
struct LetterPosition {
  glm::dvec2 at{0.0};          // on the baseline, under the letter's centre
  glm::dvec2 tangent{1.0, 0};  // of length 1
};
// Letters of these widths, one after the other, centred on a line; nothing where they are longer
// than it.
std::vector<LetterPosition> set_along(const std::vector<double>& widths_px,
                                      const std::vector<glm::dvec2>& line);
double length_of(const std::vector<glm::dvec2>& line);
// The point at that length along a line; beyond its ends it continues straight.
glm::dvec2 point_at(const std::vector<glm::dvec2>& line, double from_start);

}  // namespace belvedere
