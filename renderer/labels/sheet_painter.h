#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "base/grid.h"
#include "renderer/labels/drawing.h"

namespace belvedere {

// A drawing as pixels. The sheet has a fixed grid of small tiles, each painted on its own, so that any part of it gets the pixels of the
// whole whatever rows are asked for, memory does not grow with the sheet, and threads change nothing. Edges of shapes are covered in 255
// steps and mixed in encoded sRGB, as browsers and printers' programs do it: the picture then looks like the SVG. The only file that knows
// Cairo besides text_measure.cpp.
class SheetPainter {
 public:
  // Takes letters' outlines from the system's fonts: Error(input) where there are none and the drawing has text.
  explicit SheetPainter(const Drawing& drawing);
  ~SheetPainter();
  SheetPainter(const SheetPainter&) = delete;
  SheetPainter& operator=(const SheetPainter&) = delete;

  // Paints over a rectangle of the sheet, encoded sRGB 0…1, whose first pixel is `at`. In parallel.
  void paint(Grid<glm::vec3>& encoded, glm::ivec2 at) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace belvedere
