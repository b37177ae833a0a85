#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/progress.h"
#include "texture/strokes/base_picture.h"
#include "texture/strokes/paint_parts.h"

namespace belvedere {

// Where paint may fall. Every stroke has the depth of its seed; a gate compares it with the
// pixel's.
enum class StrokeGate : std::uint8_t {
  surface,     // only on the seed's own surface: depth within ± depth_tolerance, so texture never
               // crosses a ridge
  upright,     // may cover farther pixels, never nearer ones: trees
  sky,         // only on sky
  water,       // only on water
  same_class,  // as surface, and only on pixels of the seed's class: strokes that end with their
               // ice
};

// The shape of a stroke's ends and edges.
enum class StrokeTip : std::uint8_t {
  round,   // half discs, uniform coverage: for drawn lines
  square,  // cut off at its first and last point, uniform coverage: walls and roofs
  hairs,   // a brush of hairs: set down, pressed on, run dry; every load of paint varies slightly
};

// One brush stroke: a polyline with a width that changes from start to end. Lengths in pixels of
// the canvas.
struct Stroke {
  static constexpr int max_points = 4;
  std::array<glm::vec2, max_points> points{};
  int point_count = 0;
  float start_width = 1.F;
  float end_width = 1.F;
  float alpha = 1.F;    // 0…1
  float load = 0.F;     // of hairs, 0…1: variation of loads of paint around the requested colour
  float bristle = 0.F;  // of hairs: 0 smooth … 1 dry brush
  StrokeTip tip = StrokeTip::round;
  float edge = 0.F;  // -1…1, of hairs: paint gathers on the right (> 0) or left side and thins out
                     // on the other; 0: symmetric
  float wetness = 0.F;    // of hairs: variation of colour between them, encoded sRGB
  glm::vec3 colour{0.F};  // encoded sRGB
  float depth_m = 0.F;
  float depth_tolerance = 0.045F;  // relative
  float tone = -1.F;  // tone of the seed: alpha falls as exp(-((tone_px - tone)/tone_width)⁴); < 0:
                      // no tone gate
  float tone_width = 0.16F;  // of that gate: without it rock looks like fur
  std::uint32_t facet = 0;   // its plane of rock: a fifth of its paint remains outside it; 0: none
  StrokeGate gate = StrokeGate::surface;
  bool standing = false;   // stands on the ground: it hides features drawn there
  float order = 0.F;       // larger is painted first: usually depth
  std::uint32_t seed = 0;  // of its bristles
  PaintPart part = PaintPart::ground;
  std::uint32_t source = 0;  // index of its first pixel: its class is that pixel's
};

// A picture with the origin of its paint. Strokes overlap the borders of classes, so the paint on a
// pixel is often not of its own class.
struct Painting {
  Grid<glm::vec3> picture;  // encoded sRGB
  // Index of a pixel of the class with the thickest paint on each pixel: the origin of the thickest
  // stroke, or the pixel itself if the class is its own (SheetWindow::to_copy_from).
  Grid<std::uint32_t> sources;
  // Where two classes share a pixel: the origin of the other class's paint, the pixel itself where
  // there is none, and its visible share in 255ths of the two: at most half.
  Grid<std::uint32_t> under;
  Grid<std::uint8_t> under_share;
  Grid<std::uint32_t> strokes;  // number of the stroke with the thickest paint, counted from 1 in
                                // painting order; 0: bare canvas
  std::uint32_t stroke_count = 0;  // strokes laid so far
  Grid<float> seen_ground;  // share of each pixel, 0…1, not covered by standing objects; empty if
                            // not requested
  Grid<float> seen_overhead;  // the same for objects nearer than MappedGround::overhead_m; empty
                              // without overhead objects
};

// A painting with a bare canvas, encoded sRGB; recorded: as in SheetWindow.
Painting begin_painting(Grid<glm::vec3> canvas, bool recorded = true);

// Paints the strokes in order (ties: as listed) over the canvas. Each tile of the canvas paints the
// strokes that touch it in that order, so the result does not depend on threads and tiles.
// pixels_per_unit: see StrokeParameters. Strokes lie on the sheet; the canvas and the guidance are
// a window of it, of which only requested pixels are painted. `parts`, if given, contains the
// requested pixels and receives the paint.
void paint_in_order(Painting& painting, const GuidanceBuffers& guidance,
                    std::vector<Stroke> strokes, double pixels_per_unit, Progress& progress,
                    const SheetWindow& window = {}, PaintParts* parts = nullptr);

}  // namespace belvedere
