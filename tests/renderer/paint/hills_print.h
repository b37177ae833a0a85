#pragma once

#include "renderer/trace/camera.h"
#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere::test {

inline constexpr double print_ppu = 8.0;  // pixels per unit
inline constexpr int print_factor = 4;    // of its wide view

// Hills at print scale, and the view of a camera with a quarter of the pixels.
struct Print {
  int width = 1400;
  int height = 1100;
  GuidanceBuffers near = make_hills(width, height, print_ppu);
  GuidanceBuffers far =
      make_hills((width + print_factor - 1) / print_factor,
                 (height + print_factor - 1) / print_factor, print_ppu / print_factor);
};

struct Window {
  PixelRect rect;
  GuidanceBuffers held;
};
inline Window window_of(const GuidanceBuffers& g, PixelRect rect) {
  rect = intersection(rect, {0, 0, g.width(), g.height()});
  return {rect, cut(g, rect)};
}

}  // namespace belvedere::test
