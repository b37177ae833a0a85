#include "renderer/stages/finishing_paint.h"

#include <glm/common.hpp>
#include <utility>

#include "base/grid.h"
#include "renderer/features/house_strokes.h"
#include "renderer/features/paint_features.h"

namespace belvedere {
namespace {

// Whether lines or houses may touch a rectangle, or keep its ground clear.
bool has_features(const DrawnFeatures& features, PixelRect rect) {
  return !features.empty() &&
         (!features.lines_at(rect).empty() || !features.houses_at(rect).empty());
}

}  // namespace

FinishedPaint finish_paint(const PaintedGround& painted, const FinishingGround& ground,
                           const FinishingHand& hand, bool in_parts, Progress& progress) {
  const auto& [guidance, base, veil, crest_rows, window] = ground;
  const PixelRect inside = moved(painted.rect, -window.x0, -window.y0);
  Grid<glm::vec3> canvas = base.colour;
  if (!painted.copied.empty()) copy_part(canvas, painted.copied, inside.x0, inside.y0);
  FinishedPaint finished;
  finished.in_parts = in_parts;
  if (in_parts) {
    finished.parts.emplace(inside);
    finished.bare = part_of(canvas, inside);
    finished.mist = painted.mist;
    finished.haze = part_of(base.haze, inside);
  }
  const bool misty = !veil.empty();
  if (misty) lay_mist(canvas, {inside.x0, inside.y0}, painted.mist);
  SheetWindow position{.origin_px = {window.x0, window.y0},
                       .sheet_px = hand.sheet_px,
                       .asked = inside,
                       .ice = &hand.ice,
                       .recorded = false,
                       .ground = &base.colour};
  position.veil = misty ? &veil : nullptr;
  position.waters_known = hand.features.rivers;
  PaintParts* parts = finished.parts ? &*finished.parts : nullptr;
  const bool mapped = has_features(hand.features, window);
  MappedGround map;
  if (mapped) {
    map.cleared = find_cleared(hand.features, guidance.depth_m, window, &crest_rows);
    map.overhead_m = find_overhead(hand.features, window);
    map.besides = house_strokes(hand.features, {guidance, base, hand.strokes, position});
    position.mapped = &map;
  }
  Painting strokes = paint_strokes(std::move(canvas), guidance, base, hand.layers, hand.strokes,
                                   progress, position, parts);
  if (mapped) {
    // Mist is already painted: features fade into it by the share of mist in front of them.
    const Grid<glm::vec3> before = misty ? strokes.picture : Grid<glm::vec3>();
    const std::optional<PaintParts> parts_before = misty ? finished.parts : std::nullopt;
    paint_features(
        strokes.picture, hand.features,
        {guidance, base.colour, base.haze, strokes.seen_ground, strokes.seen_overhead, &crest_rows},
        window, painted.rect, parts);
    for (std::size_t i = 0; i < before.size(); ++i)
      strokes.picture[i] = glm::mix(strokes.picture[i], before[i], veil[i]);
    if (parts_before) parts->thin_since(*parts_before, veil);
  }
  finished.picture = part_of(strokes.picture, inside);
  return finished;
}

}  // namespace belvedere
