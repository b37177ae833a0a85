#include "renderer/stages/copied_ground.h"

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "base/grid.h"
#include "renderer/features/house_strokes.h"
#include "renderer/features/paint_features.h"
#include "renderer/paint/guides.h"

namespace belvedere {
namespace {

// Column and row of a sheet position as one number; sheets are at most 65535 px wide and high.
std::uint32_t sheet_place(int x, int y) {
  return static_cast<std::uint32_t>(y) << 16U | static_cast<std::uint32_t>(x);
}

void shift_water(Grid<glm::vec3>& copied, const CopyPlan& plan, const MatchField& matches,
                 const Grid<LandCoverClass>& shown, const Grid<float>& haze) {
  const glm::vec3 shift = plan.water_shift - plan.residual.of(plan.water_shift);
  if (shift == glm::vec3(0.F)) return;
  for (std::size_t i = 0; i < copied.size(); ++i) {
    const std::size_t from = matches[i].exemplar;
    const bool lent =
        from < plan.exemplars.size() && !(from < plan.own_sheets.size() && plan.own_sheets[from]);
    if (lent || shown[i] != LandCoverClass::water) continue;
    const float clear = haze.empty() ? 1.F : 1.F - std::clamp(haze[i], 0.F, 1.F);
    copied[i] = glm::clamp(copied[i] + clear * shift, 0.F, 1.F);
  }
}

}  // namespace

PaintDraft make_paint_draft(const GuidanceBuffers& guidance, const BasePicture& base,
                            const StrokeParameters& strokes, const SheetWindow& position,
                            Progress& progress) {
  const Painting painting =
      paint_strokes(base.colour, guidance, base, draft_layers, strokes, progress, position);
  const PaintedClasses classes = find_painted_classes(painting.sources, guidance, base.colour);
  PaintDraft draft{part_of(classes.land_cover, position.asked),
                   part_of(classes.base, position.asked), part_of(painting.under, position.asked),
                   part_of(painting.under_share, position.asked)};
  const auto width = static_cast<std::uint32_t>(guidance.width());
  for (std::uint32_t& from : draft.under)
    from = sheet_place(position.origin_px.x + static_cast<int>(from % width),
                       position.origin_px.y + static_cast<int>(from / width));
  return draft;
}

Painting to_painting(const PaintDraft& draft, PixelRect window) {
  Painting painting;
  painting.under = Grid<std::uint32_t>(window.width(), window.height());
  painting.under_share = draft.under_share;
  for (std::size_t i = 0; i < painting.under.size(); ++i) {
    const int x = static_cast<int>(draft.under[i] & 0xffffU) - window.x0;
    const int y = static_cast<int>(draft.under[i] >> 16U) - window.y0;
    const bool inside = painting.under.contains(x, y);
    painting.under[i] = static_cast<std::uint32_t>(inside ? painting.under.index(x, y) : i);
    if (!inside) painting.under_share[i] = 0;
  }
  return painting;
}

Grid<glm::vec3> copy_ground(const CopyPlan& plan, const GroundPaint& paint, const PaintDraft& draft,
                            const BasePicture& base, const Grid<LandCoverClass>& land_cover,
                            PixelRect window) {
  Grid<glm::vec3> copied = transfer_residual(paint.matches, plan.exemplars, draft.base, base.haze,
                                             plan.residual, draft.land_cover);
  shift_water(copied, plan, paint.matches, draft.land_cover, base.haze);
  if (plan.models.any())
    lay_model_paint(copied, paint.modelled, draft.base, base.haze, plan.residual, draft.land_cover);
  if (plan.seams)
    lay_even_paint(copied, paint.with_seam, draft.base, base.haze, plan.residual, draft.land_cover);
  return mix_borders(copied, to_painting(draft, window), draft.land_cover, land_cover, base.colour);
}

PaintBeforeSeams make_paint_before_seams(const CopyPlan& plan, const MatchField& matches,
                                         const ModelPaint& modelled,
                                         const Grid<LandCoverClass>& shown, Grid<float> depth_m) {
  const Grid<glm::vec3> grey(shown.width(), shown.height(), glm::vec3(even_grey));
  PaintBeforeSeams paint;
  paint.even = transfer_residual(matches, plan.exemplars, grey, {}, plan.residual, shown);
  paint.depth_m = std::move(depth_m);
  paint.source = Grid<std::uint16_t>(shown.width(), shown.height(), no_source);
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (matches[i].exemplar != Match::none)
      paint.source[i] = source_of(matches[i].exemplar, shown[i]);
  if (!plan.models.any()) return paint;
  lay_model_paint(paint.even, modelled, grey, {}, plan.residual, shown);
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (modelled.made[i] != 0)
      paint.source[i] = source_of(plan.exemplars.size() + modelled.made[i] - 1, shown[i]);
  return paint;
}

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
