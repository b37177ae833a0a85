#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "renderer/labels/drawing.h"

namespace belvedere {

// The ground that letters stand on: the painting itself, blurred, and lightened under dark letters
// or darkened under light ones as far as they need. Colours are encoded sRGB, 0…1.

// Relative luminance of a colour, 0…1, and the contrast of two (WCAG 2.1): (Y₁ + .05) / (Y₂ + .05),
// 1…21.
double luminance(glm::vec3 colour);
double contrast(glm::vec3 a, glm::vec3 b);

// Target of a halo.
struct HaloAim {
  glm::vec3 letters{0.0F};
  double contrast = 4.0;  // of the letters to every colour of the halo
  bool lightens = true;   // else it darkens, under light letters
};
// A colour of the painting, changed no more than the aim needs, and a little in any case, so that
// halos are seen as light, not as paper: its hue stays until white or black is near.
glm::vec3 halo_colour(glm::vec3 paint, const HaloAim& aim);

// A window of the picture.
struct PictureWindow {
  const Grid<glm::vec3>& pixels;
  glm::ivec2 at{0};  // position of its first pixel
};
// The mean of the picture around each pixel of a rectangle: three box filters in a row, of
// 2 radius + 1 pixels each, in whole numbers, so that any window that contains the pixels within
// halo_reach_px gives the same bits. At the window's edges the picture continues as its last pixel.
Grid<glm::vec3> blurred(const PictureWindow& picture, PixelRect rect, int radius_px);
constexpr int halo_reach_px(int radius_px) { return 3 * radius_px; }
// The radius under halos of that width: a stroke of the brush is no longer seen beside a letter.
int halo_blur_px(double halo_px);

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
