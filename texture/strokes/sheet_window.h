#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"

namespace belvedere {

struct IcePlan;
struct Stroke;

// What a map knows of the ground, for strokes to keep out of its way: roads are clear of trees, houses stand where they are.
struct MappedGround {
  Grid<std::uint8_t> cleared;   // of the buffers' pixels: 1 where nothing grows that stands up
  std::vector<Stroke> besides;  // what stands there besides, in depth order with all that grows
  Grid<float> hung_m;           // how far from the eye something hangs in the air there, infinite where nothing does; empty: nowhere
};

// Which part of the sheet the buffers hold that strokes are painted from and on. Places of strokes are places of the sheet, px, so that a
// window shows what the whole shows; pixels are counted from the window's corner.
struct SheetWindow {
  glm::ivec2 origin_px{0};               // where the buffers' first pixel lies on the sheet
  glm::ivec2 sheet_px{0};                // width and height of the sheet; 0: the buffers hold all of it
  PixelRect asked{};                     // pixels of the buffers that are wanted, the others may be left unpainted; empty: all
  const IcePlan* ice = nullptr;          // how ice runs on the whole sheet; null: told by the buffers, which then must hold all of it
  bool waters_known = false;             // a map gives rivers: they are narrow, and paint of their banks keeps off them
  bool to_copy_from = false;             // Painting::sources tells of the very strokes, also within a class and on water; else the pixel
                                         // itself counts for paint of its class, and water for what leans over it: rivers stay whole
  const Grid<float>* veil = nullptr;     // of the buffers' pixels: share of mist before them, 0…1; null: there is none
  const MappedGround* mapped = nullptr;  // null: nothing is known, and what stands is not told
};

}  // namespace belvedere
