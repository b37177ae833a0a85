#pragma once

#include <glm/vec2.hpp>

#include "base/parallel.h"

namespace belvedere {

struct IcePlan;

// Which part of the sheet the buffers hold that strokes are painted from and on. Places of strokes are places of the sheet, px, so that a
// window shows what the whole shows; pixels are counted from the window's corner.
struct SheetWindow {
  glm::ivec2 origin_px{0};       // where the buffers' first pixel lies on the sheet
  glm::ivec2 sheet_px{0};        // width and height of the sheet; 0: the buffers hold all of it
  PixelRect asked{};             // pixels of the buffers that are wanted, the others may be left unpainted; empty: all
  const IcePlan* ice = nullptr;  // how ice runs on the whole sheet; null: told by the buffers, which then must hold all of it
};

}  // namespace belvedere
