#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "texture/strokes/paint_parts.h"

namespace belvedere {

// Where paint may fall. Every stroke has the depth of its seed; a gate compares it with the pixel's.
enum class StrokeGate : std::uint8_t {
  surface,     // only on the seed's own surface: depth within ± depth_tolerance, so texture never swims across a ridge
  upright,     // may cover what is farther, never what is nearer: trees
  sky,         // only on sky
  water,       // only on water
  same_class,  // as surface, and only on pixels of the seed's class: what ends with the ice it lies on
};

// How a stroke begins, ends and is edged.
enum class StrokeTip : std::uint8_t {
  round,   // half discs, evenly covered: for what is drawn rather than painted
  square,  // cut off at its first and last point, evenly covered: walls and roofs
  hairs,   // a brush of hairs: set down, pressed on, run dry; every load of paint differs a little
};

// One stroke of the brush: a polyline with a width that runs from start to end. Lengths in pixels of the canvas.
struct Stroke {
  static constexpr int max_points = 4;
  std::array<glm::vec2, max_points> points{};
  int point_count = 0;
  float start_width = 1.F;
  float end_width = 1.F;
  float alpha = 1.F;    // 0…1
  float load = 0.F;     // of hairs, 0…1: how much loads of paint differ from the colour asked for
  float bristle = 0.F;  // of hairs: 0 smooth … 1 dry brush
  StrokeTip tip = StrokeTip::round;
  float edge = 0.F;       // -1…1, of hairs: paint gathers on the right (> 0) or left side and thins out on the other; 0: both alike
  float wetness = 0.F;    // of hairs: how much colour varies between them, encoded sRGB
  glm::vec3 colour{0.F};  // encoded sRGB
  float depth_m = 0.F;
  float depth_tolerance = 0.045F;  // relative
  float tone = -1.F;               // tone of the seed: alpha falls as exp(-((tone_px - tone)/tone_width)⁴); < 0: no tone gate
  float tone_width = 0.16F;        // of that gate: without it rock turns to fur
  std::uint32_t facet = 0;         // plane of rock it belongs to: beyond that plane a fifth of its paint is left; 0: none
  StrokeGate gate = StrokeGate::surface;
  bool standing = false;   // stands on the ground: it hides what is drawn there
  float order = 0.F;       // larger is painted first: usually depth
  std::uint32_t seed = 0;  // of its bristles
  PaintPart part = PaintPart::ground;
  std::uint32_t source = 0;  // index of the pixel it grew from: its class is that pixel's
};

// A picture with the origin of its paint. Strokes overlap the borders of classes, so what a pixel shows is often not what stands there.
struct Painting {
  Grid<glm::vec3> picture;  // encoded sRGB
  // Index of a pixel of the class whose paint lies thickest on each pixel: where the thickest of its strokes grew, or the pixel itself
  // where the class is its own (SheetWindow::to_copy_from).
  Grid<std::uint32_t> sources;
  // Where two classes share a pixel: a pixel that the other class's paint grew from, itself where there is none, and how much of it
  // shows, in 255ths of the two: at most half.
  Grid<std::uint32_t> under;
  Grid<std::uint8_t> under_share;
  Grid<std::uint32_t> strokes;  // number of the stroke whose paint lies thickest, counted from 1 in the order of painting; 0: bare canvas
  std::uint32_t stroke_count = 0;  // strokes laid so far
  Grid<float> seen_ground;         // share of each pixel, 0…1, that nothing standing covers; empty where it is not asked for
  Grid<float> seen_hung;           // the same of what stands nearer than MappedGround::hung_m; empty where nothing hangs
};

}  // namespace belvedere
