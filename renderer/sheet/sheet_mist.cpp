#include "renderer/sheet/sheet_mist.h"

namespace belvedere {
namespace {

constexpr int mist_tile_px = 256;

}  // namespace

SheetMist::SheetMist(SheetGround& ground, const World& world, TileStore::Place& place, const Run& run)
    : ground_(ground),
      world_(world),
      run_(run),
      sight_(place, ground.sheet().x1, ground.sheet().y1, mist_tile_px,
             {.make = [this](PixelRect tile) { return make_sight(tile); },
              .blank =
                  [](int width, int height) {
                    const Grid<float> grid(width, height);
                    return MistSight{grid, grid, grid, grid};
                  },
              .planes =
                  [](MistSight& sight) {
                    return Planes{plane_of(sight.share), plane_of(sight.depth_m), plane_of(sight.light), plane_of(sight.altitude_m)};
                  },
              .whole_tiles = true}),
      paint_(place, ground.sheet().x1, ground.sheet().y1, mist_tile_px,
             {.make = [this](PixelRect tile) { return make_paint(tile); },
              .blank =
                  [](int width, int height) {
                    return MistPaint{Grid<float>(width, height), Grid<glm::vec3>(width, height)};
                  },
              .planes =
                  [](MistPaint& paint) {
                    return Planes{plane_of(paint.share), plane_of(paint.colour)};
                  },
              .whole_tiles = true}) {}

MistSight SheetMist::make_sight(PixelRect tile) {
  const MistView view{ground_.view().camera, world_.deformation, &world_.tracer, world_.view.sun_direction, ground_.view().pixels_per_unit};
  const Grid<float> depth_m = ground_.read_guidance(tile, {&GuidanceBuffers::depth_m}, false).depth_m;
  return see_mist(world_.mist, view, depth_m, {tile.x0, tile.y0});
}

MistPaint SheetMist::make_paint(PixelRect tile) {
  const PixelRect window = intersection(ground_.sheet(), grown(tile, mist_margin_px(ground_.strokes())));
  const SheetWindow place{.origin_px = {window.x0, window.y0},
                          .sheet_px = {ground_.sheet().x1, ground_.sheet().y1},
                          .asked = moved(tile, -window.x0, -window.y0)};
  return paint_mist(sight_.read(window), world_.view.air, ground_.palette(), ground_.strokes(), place, run_.progress);
}

void SheetMist::prepare(PixelRect veil, PixelRect paint) {
  sight_.prepare(veil);
  paint_.prepare(paint);
}

Grid<float> SheetMist::read_veil(PixelRect rect) {
  Grid<float> veil(rect.width(), rect.height());
  sight_.read_into(rect, {plane_of(veil), {}, {}, {}});
  return veil;
}

MistPaint SheetMist::read_paint(PixelRect rect) { return paint_.read(rect); }

int SheetMist::margin_px() const { return mist_tile_px + mist_margin_px(ground_.strokes()) + mist_tile_px; }

void SheetMist::keep_only(PixelRect still) {
  paint_.keep_only(still);
  sight_.keep_only(grown(still, mist_tile_px + mist_margin_px(ground_.strokes())));
}

}  // namespace belvedere
