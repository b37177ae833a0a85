#pragma once

#include <cstddef>
#include <cstdint>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "texture/strokes/stroke.h"

namespace belvedere {

// The origin of the paint on the pixels of one tile: the class with the thickest paint, the second
// most visible class, and the stroke on top. A layer of another class hides the paint below by its
// opacity, one of the same class adds to it; of three classes on one pixel the thinnest is dropped,
// of several strokes of one class all but the thickest.
class PaintRecord {
 public:
  // Starts from the current state of the painting: two classes with their shares, and one thick
  // layer where a stroke is on top. to_copy_from: as in SheetWindow. Without it paint of other
  // classes on water is not recorded: a brook overhung by grass is still one line.
  PaintRecord(const Painting& painting, const GuidanceBuffers& guidance, PixelRect tile,
              bool to_copy_from);

  // A stroke, number `number`, lays paint of opacity alpha on pixel x, y of the canvas.
  void cover(int x, int y, const Stroke& stroke, std::uint32_t number, float alpha);

  // Writes sources, under, under_share and strokes of the tile.
  void hand_back(Painting& painting) const;

 private:
  // Of one class.
  struct Paint {
    std::uint32_t source;  // origin of its thickest stroke
    float share;           // 0…1; 0: none
    float source_share;    // … of that stroke alone
    void thin(float by);
    void add(std::uint32_t from, float alpha);
  };
  struct Layers {
    Paint top;
    Paint under;           // of the other class
    std::uint32_t stroke;  // number of the stroke on top
    float stroke_share;    // 0…1
  };

  const GuidanceBuffers& guidance_;
  PixelRect tile_;
  bool to_copy_from_;
  Grid<Layers> layers_;
};

}  // namespace belvedere
