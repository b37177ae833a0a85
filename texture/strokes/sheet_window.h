#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"

namespace belvedere {

struct IcePlan;
struct Stroke;

// Mapped ground that strokes must respect: roads are clear of trees, houses stand at their
// positions.
struct MappedGround {
  Grid<std::uint8_t> cleared;   // of the buffers' pixels: 1 where nothing may stand
  std::vector<Stroke> besides;  // strokes of mapped objects, in depth order with all vegetation
  Grid<float> overhead_m;  // distance from the eye of an overhead object (a rope), infinite where
                           // there is none; empty: nowhere
};

// The part of the sheet that the buffers contain. Positions of strokes are sheet positions, px, so
// that a window shows the same as the whole; pixels are counted from the window's corner.
struct SheetWindow {
  glm::ivec2 origin_px{0};       // position of the buffers' first pixel on the sheet
  glm::ivec2 sheet_px{0};        // width and height of the sheet; 0: the buffers contain all of it
  PixelRect asked{};             // requested pixels of the buffers, others may stay unpainted;
                                 // empty: all
  const IcePlan* ice = nullptr;  // ice of the whole sheet; null: derived from the buffers,
                                 // which must then contain all of it
  bool waters_known =
      false;  // a map gives rivers: they are narrow, and the paint of their banks is kept off them
  bool to_copy_from = false;  // Painting::sources records the actual strokes, also within a class
                              // and on water; otherwise a pixel counts as the source of paint of
                              // its own class, and water as that of overhanging paint: rivers stay
                              // whole
  bool recorded = true;       // whether the origin of paint is wanted: Painting::sources, under,
                              // under_share, strokes; otherwise they stay empty
  const Grid<glm::vec3>* ground = nullptr;  // of the buffers' pixels: colours of the bare ground,
                                            // encoded sRGB, that strokes of its own class stay
                                            // near; null: they keep their own
  const Grid<float>* veil =
      nullptr;  // of the buffers' pixels: share of mist in front, 0…1; null: none
  const MappedGround* mapped =
      nullptr;  // null: nothing is mapped, and standing objects are not recorded
};

}  // namespace belvedere
