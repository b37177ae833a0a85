#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "base/grid.h"
#include "renderer/labels/drawing.h"
#include "renderer/labels/paint_halo.h"

namespace belvedere {

// Rasterizes a drawing. The sheet has a fixed grid of small tiles, each painted independently, so
// that any part of it gets the same pixels whatever rows are requested, memory does not grow with
// the sheet, and threads change nothing. Edges of shapes are antialiased in 255 steps and blended
// in encoded sRGB, as in browsers and printers' programs, so that the picture looks like the SVG.
// Halos of the painting lie over the shapes before the first text that has one, and below all
// others.
// The only file besides text_measure.cpp that uses Cairo.
class SheetPainter {
 public:
  // Takes letters' outlines from the system's fonts: Error(input) where there are none and the
  // drawing has text.
  explicit SheetPainter(const Drawing& drawing);
  ~SheetPainter();
  SheetPainter(const SheetPainter&) = delete;
  SheetPainter& operator=(const SheetPainter&) = delete;

  // Paints over a rectangle of the sheet, encoded sRGB 0…1, whose first pixel is `at`. In parallel.
  // `picture`: the painting below, to the sheet's edge or at least halo_reach() around the
  // rectangle; without it, halos have their plain colours.
  void paint(Grid<glm::vec3>& encoded, glm::ivec2 at, const PictureWindow* picture = nullptr) const;
  // How far around a pixel the painting is read, px; 0 without halos.
  int halo_reach() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace belvedere
