#pragma once

#include <glm/vec3.hpp>

#include "base/run.h"
#include "renderer/mist/mist_paint.h"
#include "renderer/mist/mist_sight.h"
#include "renderer/sheet/sheet_ground.h"
#include "renderer/sheet/sheet_stage.h"
#include "renderer/sheet/tile_store.h"

namespace belvedere {

// The mist of a sheet in any rectangles, with the same bits as in one piece: what pixels see of it, and its paint. Mist lies before the
// ground that a pixel shows. What stands on ground is painted over it later, as thin as the mist before its foot leaves it, so that trees
// stand in the mist or before it.
class SheetMist {
 public:
  // All arguments must outlive it.
  SheetMist(SheetGround& ground, const World& world, TileStore::Place& place, const Run& run);

  bool any() const { return !world_.mist.empty(); }
  // Makes what reading them makes (SheetStage::prepare).
  void prepare(PixelRect veil, PixelRect paint);
  // What it hides at each pixel, 0…1, before it is painted.
  Grid<float> read_veil(PixelRect rect);
  // Its paint, encoded sRGB.
  MistPaint read_paint(PixelRect rect);
  void keep_only(PixelRect still);
  // How far its paint looks at the ground around.
  int margin_px() const;

 private:
  MistSight make_sight(PixelRect tile);
  MistPaint make_paint(PixelRect tile);

  SheetGround& ground_;
  const World& world_;
  const Run& run_;
  SheetStage<MistSight> sight_;
  SheetStage<MistPaint> paint_;
};

}  // namespace belvedere
