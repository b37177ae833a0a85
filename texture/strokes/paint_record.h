#pragma once

#include <cstddef>
#include <cstdint>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/parallel.h"
#include "texture/strokes/stroke.h"

namespace belvedere {

// Whose paint lies on the pixels of one tile: the class whose paint lies thickest, the one that shows most beside it, and the stroke on
// top. A layer of another class hides what lies below by its opacity, one of the same class adds to it; of three classes on one pixel the
// thinnest is forgotten. Water may keep its shores: a brook that grass leans over is still one line.
class PaintRecord {
 public:
  // Takes up what the painting holds: two classes in their shares, and one thick layer where a stroke lies on top.
  // keep_shores: paint of others on water is not recorded (SheetWindow::keep_shores).
  PaintRecord(const Painting& painting, const GuidanceBuffers& guidance, PixelRect tile, bool keep_shores = true);

  // A stroke, number `number`, lays paint of opacity alpha on pixel x, y of the canvas.
  void cover(int x, int y, const Stroke& stroke, std::uint32_t number, float alpha);

  // Writes sources, under, under_share and strokes of the tile.
  void hand_back(Painting& painting) const;

 private:
  struct Layers {
    std::uint32_t source;        // where the paint on top grew from
    float share;                 // 0…1 of its class
    std::uint32_t under_source;  // where the other class's paint grew from
    float under_share;           // 0…1; 0: none
    std::uint32_t stroke;        // number of the stroke on top
    float stroke_share;          // 0…1
  };

  const GuidanceBuffers& guidance_;
  PixelRect tile_;
  bool keep_shores_;
  Grid<Layers> layers_;
};

}  // namespace belvedere
