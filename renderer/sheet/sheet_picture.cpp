#include "renderer/sheet/sheet_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "base/grid_part.h"
#include "renderer/features/house_strokes.h"
#include "renderer/features/paint_features.h"

namespace belvedere {
namespace {

using B = GuidanceBuffers;

constexpr int knit_tile_px = 512;

// What the exemplar cannot give is painted last, far to near: sky, trees, houses; without an exemplar everything is.
StrokeLayers finishing_layers(bool copied) { return {.sky = true, .ground = !copied, .accents = true, .breaks = true, .upright = true}; }

// A rectangle with all of the tiles that it touches.
PixelRect with_whole_tiles(PixelRect rect, int tile_px) {
  const auto down = [&](int px) { return std::max(px, 0) / tile_px * tile_px; };
  const auto up = [&](int px) { return (px + tile_px - 1) / tile_px * tile_px; };
  return {down(rect.x0), down(rect.y0), up(rect.x1), up(rect.y1)};
}

// The draft as a painting of a window of the sheet, for mix_borders: paint that comes from outside of the window is left out.
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

}  // namespace

SheetPicture::SheetPicture(SheetGround& ground, CopyPlan* plan, TileStore::Place& place, const Run& run, const DrawnFeatures& features)
    : ground_(ground),
      plan_(plan),
      run_(run),
      layers_(finishing_layers(plan != nullptr)),
      features_(features),
      mist_(ground, ground.world(), place, run),
      matches_(place, ground.sheet().x1, ground.sheet().y1, plan == nullptr ? SynthesisSheet{}.tile_px : plan->synthesis->sheet().tile_px,
               {.make = [this](PixelRect tile) { return make_matches(tile); },
                .blank = [](int width, int height) { return MatchField(width, height); },
                .planes = [](MatchField& field) { return Planes{plane_of(field)}; },
                .whole_tiles = true}),
      modelled_(place, ground.sheet().x1, ground.sheet().y1, endless_tile_px,
                {.make = [this](PixelRect tile) { return make_modelled(tile); },
                 .blank =
                     [](int width, int height) {
                       return ModelPaint{Grid<std::uint8_t>(width, height), Grid<glm::vec3>(width, height), Grid<glm::vec3>(width, height)};
                     },
                 .planes =
                     [](ModelPaint& paint) {
                       return Planes{plane_of(paint.made), plane_of(paint.texel), plane_of(paint.base)};
                     },
                 .whole_tiles = true}),
      seams_(plan != nullptr && plan->knit ? &*plan->knit : nullptr),
      knitted_(place, ground.sheet().x1, ground.sheet().y1, knit_tile_px,
               {.make = [this](PixelRect tile) { return make_knitted(tile); },
                .blank =
                    [](int width, int height) {
                      return KnitPaint{Grid<std::uint8_t>(width, height), Grid<glm::vec3>(width, height)};
                    },
                .planes =
                    [](KnitPaint& paint) {
                      return Planes{plane_of(paint.made), plane_of(paint.even)};
                    },
                .whole_tiles = true}) {}

MatchField SheetPicture::make_matches(PixelRect tile) {
  SynthesisPlan& plan = *plan_->synthesis;
  // A plan of the whole size has all that is asked.
  if (plan.sheet().level == 0) return synthesize_tile(plan, {}, tile, run_.progress);
  GuideStack guides = ground_.read_guides(synthesis_window(plan.sheet(), tile));
  hide_modelled(guides, plan_->models);
  return synthesize_tile(plan, guides, tile, run_.progress);
}

ModelPaint SheetPicture::make_modelled(PixelRect tile) {
  const PixelRect window = intersection(ground_.sheet(), grown(tile, model_margin_px(plan_->models)));
  const GuidanceBuffers guidance = ground_.read_guidance(window, {&B::depth_m, &B::land_cover, &B::fall_line}, false);
  const Grid<float> tone = plan_->models.by_light() ? ground_.read_guidance(tile, {&B::depth_m}, true).tone : Grid<float>();
  return make_model_paint(plan_->models, tile, ground_.read_draft(tile).land_cover, guidance, window, tone);
}

KnitPaint SheetPicture::make_knitted(PixelRect tile) {
  const PixelRect window = intersection(ground_.sheet(), grown(tile, knit_margin_px));
  matches_.prepare(window);
  if (plan_->models.any()) modelled_.prepare(window);
  const Grid<LandCoverClass> shown = ground_.read_draft(window).land_cover;
  const MatchField matches = matches_.read(window);
  const Grid<glm::vec3> grey(window.width(), window.height(), glm::vec3(even_grey));
  UnknitPaint paint;
  paint.even = transfer_residual(matches, plan_->exemplars, grey, {}, plan_->residual, shown);
  paint.depth_m = ground_.read_guidance(window, {&B::depth_m}, false).depth_m;
  paint.source = Grid<std::uint16_t>(window.width(), window.height(), no_source);
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (matches[i].exemplar != Match::none) paint.source[i] = source_of(matches[i].exemplar, shown[i]);
  if (plan_->models.any()) {
    const ModelPaint modelled = modelled_.read(window);
    lay_model_paint(paint.even, modelled, grey, {}, plan_->residual, shown);
    for (std::size_t i = 0; i < matches.size(); ++i)
      if (modelled.made[i] != 0) paint.source[i] = source_of(plan_->exemplars.size() + modelled.made[i] - 1, shown[i]);
  }
  return knit_ground(seams_, paint, tile, window, plan_->knit->seed);
}

PixelRect SheetPicture::copy_window(PixelRect rect) const {
  return intersection(ground_.sheet(), grown(rect, paint_source_reach_px(draft_layers, ground_.strokes())));
}

void SheetPicture::prepare_copy(PixelRect rect) {
  const PixelRect window = copy_window(rect);
  matches_.prepare(window);
  if (plan_->models.any()) modelled_.prepare(window);
  if (plan_->knit) knitted_.prepare(window);
  ground_.prepare_draft(window);
}

Grid<glm::vec3> SheetPicture::copy_ground(PixelRect rect) {
  const PixelRect window = copy_window(rect);
  const PaintDraft draft = ground_.read_draft(window);
  const BasePicture base = ground_.read_base(window);
  const GuidanceBuffers guidance = ground_.read_guidance(window, {&B::depth_m, &B::land_cover}, false);
  Grid<glm::vec3> copied =
      transfer_residual(matches_.read(window), plan_->exemplars, draft.base, base.haze, plan_->residual, draft.land_cover);
  if (plan_->models.any()) lay_model_paint(copied, modelled_.read(window), draft.base, base.haze, plan_->residual, draft.land_cover);
  if (plan_->knit) lay_even_paint(copied, knitted_.read(window), draft.base, base.haze, plan_->residual, draft.land_cover);
  const Grid<glm::vec3> mixed = mix_borders(copied, to_painting(draft, window), draft.land_cover, guidance.land_cover, base.colour);
  return part_of(mixed, moved(rect, -window.x0, -window.y0));
}

StrokeLayers SheetPicture::layers_around(PixelRect rect) {
  StrokeLayers layers = layers_;
  const PixelRect widest = intersection(ground_.sheet(), grown(rect, stroke_margin_px(layers_, ground_.strokes())));
  const Grid<float> depth_m = ground_.read_guidance(widest, {&B::depth_m}, false).depth_m;
  layers.sky = layers.sky && std::any_of(depth_m.begin(), depth_m.end(), [](float depth) { return std::isinf(depth); });
  return layers;
}

int SheetPicture::finish_margin_px(const StrokeLayers& layers) const {
  return std::max(stroke_margin_px(layers, ground_.strokes()), features_.house_reach_px);
}

bool SheetPicture::has_features(PixelRect rect) const {
  return !features_.empty() && (!features_.lines_at(rect).empty() || !features_.houses_at(rect).empty());
}

Grid<glm::vec3> SheetPicture::make(PixelRect rect, PictureLayers* cut) {
  const PixelRect painted = intersection(ground_.sheet(), grown(rect, blend_margin_px));
  const StrokeLayers layers = layers_around(painted);
  const PixelRect window = intersection(ground_.sheet(), grown(painted, finish_margin_px(layers)));
  const PixelRect inside = moved(painted, -window.x0, -window.y0);
  if (mist_.any()) mist_.prepare(window, painted);
  if (plan_ != nullptr) prepare_copy(painted);
  ground_.prepare_base(window);
  // Copied before memory is taken for what lies around.
  const Grid<glm::vec3> copied = plan_ != nullptr ? copy_ground(painted) : Grid<glm::vec3>();
  const GuidanceBuffers guidance = ground_.read_guidance(window, stroke_channels(), true);
  const BasePicture base = ground_.read_base(window);
  Grid<glm::vec3> canvas = base.colour;
  if (plan_ != nullptr) copy_part(canvas, copied, inside.x0, inside.y0);
  const PixelRect wanted = moved(rect, -painted.x0, -painted.y0);
  std::optional<PaintParts> parts;
  Grid<glm::vec3> bare;
  if (cut != nullptr) {
    parts.emplace(inside);
    bare = part_of(canvas, moved(rect, -window.x0, -window.y0));
  }
  Grid<float> veil;
  MistPaint mist;
  if (mist_.any()) {
    veil = mist_.read_veil(window);
    mist = mist_.read_paint(painted);
    lay_mist(canvas, {inside.x0, inside.y0}, mist);
    mist = {part_of(mist.share, wanted), part_of(mist.colour, wanted)};
  }
  SheetWindow place{.origin_px = {window.x0, window.y0}, .sheet_px = ground_.view().camera.size(), .asked = inside, .ice = &ground_.ice()};
  place.veil = mist_.any() ? &veil : nullptr;
  place.waters_known = features_.rivers;
  const bool mapped = has_features(window);
  MappedGround map;
  Grid<std::int16_t> crest_rows;
  if (mapped) {
    crest_rows = ground_.read_crest_rows(window);
    map.cleared = find_cleared(features_, guidance.depth_m, window, &crest_rows);
    map.hung_m = find_hung(features_, window);
    map.besides = house_strokes(features_, {guidance, base, ground_.strokes(), place});
    place.mapped = &map;
  }
  Painting strokes =
      paint_strokes(std::move(canvas), guidance, base, layers, ground_.strokes(), run_.progress, place, parts ? &*parts : nullptr);
  if (mapped) {
    // Ways stand in the mist, which is laid already: what lies before them shows what was there.
    const Grid<glm::vec3> before = mist_.any() ? strokes.picture : Grid<glm::vec3>();
    const std::optional<PaintParts> parts_before = mist_.any() ? parts : std::nullopt;
    paint_features(strokes.picture, features_, {guidance, base.colour, base.haze, strokes.seen_ground, strokes.seen_hung, &crest_rows},
                   window, painted, parts ? &*parts : nullptr);
    for (std::size_t i = 0; i < before.size(); ++i) strokes.picture[i] = glm::mix(strokes.picture[i], before[i], veil[i]);
    if (parts_before) parts->thin_since(*parts_before, veil);
  }
  const GuidanceBuffers edges = ground_.read_guidance(painted, {&B::depth_m, &B::front}, false);
  Grid<glm::vec3> finished = part_of(blend_edges(part_of(strokes.picture, inside), edges), wanted);
  if (cut != nullptr) {
    const GuidanceBuffers about = ground_.read_guidance(rect, {&B::depth_m, &B::land_cover, &B::shadow, &B::tone}, true);
    const PixelRect in_window = moved(rect, -window.x0, -window.y0);
    *cut = cut_layers(bare, mist, *parts, wanted, about, part_of(base.haze, in_window), finished);
  }
  return finished;
}

void SheetPicture::keep_only(PixelRect still) {
  const PixelRect painted = grown(still, blend_margin_px);
  const PixelRect finished = grown(painted, finish_margin_px(layers_));
  mist_.keep_only(finished);
  SheetGround::Asked asked{.guidance = mist_.any() ? grown(finished, mist_.margin_px()) : finished, .base = finished, .draft = {}};
  if (plan_ != nullptr) {
    const PixelRect copied = copy_window(painted);
    // Knitting looks at the paint of its tile and around it.
    const PixelRect shown = plan_->knit ? grown(copied, knit_tile_px + knit_margin_px) : copied;
    knitted_.keep_only(copied);
    matches_.keep_only(shown);
    modelled_.keep_only(shown);
    asked.draft = shown;
    const SynthesisSheet& sheet = plan_->synthesis->sheet();
    if (sheet.level > 0) asked.draft = around_both(asked.draft, synthesis_window(sheet, with_whole_tiles(shown, sheet.tile_px)));
    if (plan_->models.any()) {
      const PixelRect modelled = with_whole_tiles(shown, endless_tile_px);
      asked.draft = around_both(asked.draft, modelled);
      asked.guidance = around_both(asked.guidance, grown(modelled, model_margin_px(plan_->models)));
    }
  }
  ground_.keep_only(asked);
}

}  // namespace belvedere
