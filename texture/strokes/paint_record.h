#pragma once

#include <cstddef>
#include <cstdint>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "texture/strokes/stroke.h"

namespace belvedere {

// Whose paint lies on the pixels of one tile: the class whose paint lies thickest, the one that shows most beside it, and the stroke on
// top. A layer of another class hides what lies below by its opacity, one of the same class adds to it; of three classes on one pixel the
// thinnest is forgotten, of several strokes of one class all but the thickest.
class PaintRecord {
 public:
  // Takes up what the painting holds: two classes in their shares, and one thick layer where a stroke lies on top.
  // to_copy_from: as SheetWindow's. Without it paint of others on water is not recorded: a brook that grass leans over is still one line.
  PaintRecord(const Painting& painting, const GuidanceBuffers& guidance, PixelRect tile, bool to_copy_from);

  // A stroke, number `number`, lays paint of opacity alpha on pixel x, y of the canvas.
  void cover(int x, int y, const Stroke& stroke, std::uint32_t number, float alpha);

  // Writes sources, under, under_share and strokes of the tile.
  void hand_back(Painting& painting) const;

 private:
  // Of one class.
  struct Paint {
    std::uint32_t source;  // where its thickest stroke grew from
    float share;           // 0…1; 0: none
    float source_share;    // … of that stroke alone
    void thin(float by);
    void add(std::uint32_t from, float alpha);
  };
  struct Layers {
    Paint top;
    Paint under;           // the other class's
    std::uint32_t stroke;  // number of the stroke on top
    float stroke_share;    // 0…1
  };

  const GuidanceBuffers& guidance_;
  PixelRect tile_;
  bool to_copy_from_;
  Grid<Layers> layers_;
};

}  // namespace belvedere
