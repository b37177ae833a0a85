#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/grid.h"
#include "renderer/features/drawn_features.h"
#include "renderer/mist/mist_sight.h"
#include "renderer/rock/rock_ground.h"
#include "renderer/stages/copied_ground.h"
#include "renderer/stages/ground_inputs.h"
#include "renderer/stages/lit_picture.h"
#include "renderer/stages/sheet_style.h"
#include "renderer/stages/stages.h"
#include "renderer/style/paint_style.h"
#include "texture/sheet/synthesis_tile.h"

// From the lit ground to the finished picture.
namespace belvedere {
namespace {

using B = GuidanceBuffers;
using Channels = std::vector<GuidanceMember>;

constexpr int mist_tile_px = 256;
constexpr int seam_tile_px = 512;
constexpr double style_work_bytes = 130.0;  // as stroke_work_bytes

bool shows_sky(const GuidanceBuffers& guidance) {
  return std::any_of(guidance.depth_m.begin(), guidance.depth_m.end(),
                     [](float depth) { return std::isinf(depth); });
}

}  // namespace

PictureStages add_picture_stages(StageGraph& graph, const GroundStages& ground, CopyPlan* plan,
                                 const DrawnFeatures& features) {
  const std::shared_ptr<const GroundInputs> in = ground.inputs;
  const glm::dvec3 origin_m = in->world == nullptr ? glm::dvec3(0.0) : in->world->surface->origin;
  const auto whole_tiles = [&](const char* name, int tile_px) {
    return StageNode::Declaration{
        .name = name, .size_px = in->size_px, .tile_px = tile_px, .whole_tiles = true};
  };
  const auto view = [&](const char* name) {
    return StageNode::Declaration{.name = name, .size_px = in->size_px};
  };
  const auto some = [&](Channels of) { return with_channels(std::move(of), origin_m); };
  const auto shown = with_grids(&PaintDraft::land_cover);
  PictureStages picture;

  if (plan != nullptr) {
    // The texel and exemplar that every pixel is copied from. A plan of the whole size contains
    // everything needed.
    const SynthesisSheet& division = plan->synthesis->sheet();
    picture.matches = graph.add_tiles<MatchField>(
        whole_tiles("matches", division.tile_px), one_grid<MatchField>(),
        inputs(reads(division.level == 0 ? nullptr : ground.guides,
                     around(synthesis_margin_px(division.level)))),
        [in, plan](const Tile& tile, const Window<GuideStack>& seen) {
          if (!plan->models.any())
            return synthesize_tile(*plan->synthesis, seen.value, tile.rect, in->run.progress);
          GuideStack guides = seen.value;
          hide_modelled(guides, plan->models);
          return synthesize_tile(*plan->synthesis, guides, tile.rect, in->run.progress);
        });

    // Classes that are painted from texture models instead.
    if (plan->models.any())
      picture.modelled = graph.add_tiles<ModelPaint>(
          whole_tiles("texture models", endless_tile_px),
          grids_of(&ModelPaint::made, &ModelPaint::texel, &ModelPaint::base),
          inputs(reads(ground.draft, {}, shown),
                 reads(ground.raised, around(model_margin_px(plan->models)),
                       some({&B::depth_m, &B::land_cover, &B::fall_line})),
                 reads(plan->models.by_light() ? ground.tone : nullptr)),
          [plan](const Tile& tile, const auto& draft, const auto& raised, const auto& tone) {
            return make_model_paint(plan->models, tile.rect, draft.value.land_cover, raised.value,
                                    raised.rect, tone.value);
          });

    // Synthesized seams between the paint of several paintings.
    if (plan->seams)
      picture.with_seam = graph.add_tiles<SeamPaint>(
          whole_tiles("synthesized seams", seam_tile_px),
          grids_of(&SeamPaint::made, &SeamPaint::even),
          inputs(reads(picture.matches, around(seam_margin_px)),
                 reads(picture.modelled, around(seam_margin_px)),
                 reads(ground.draft, around(seam_margin_px), shown),
                 reads(ground.crested, around(seam_margin_px), some({&B::depth_m}))),
          [plan, seams = std::make_shared<SeamModels>(&*plan->seams)](
              const Tile& tile, const auto& matches, const auto& modelled, const auto& draft,
              const auto& crested) {
            const PaintBeforeSeams paint =
                make_paint_before_seams(*plan, matches.value, modelled.value,
                                        draft.value.land_cover, crested.value.depth_m);
            return synthesize_ground_seams(*seams, paint, tile.rect, matches.rect,
                                           plan->seams->seed);
          });

    // Texels with the difference of the base pictures applied.
    const Reach source_reach = around(paint_source_reach_px(draft_layers, in->strokes));
    picture.copied = graph.add_view<Grid<glm::vec3>>(
        view("copied ground"), one_grid<Grid<glm::vec3>>(),
        inputs(reads(picture.matches, source_reach), reads(picture.modelled, source_reach),
               reads(picture.with_seam, source_reach), reads(ground.draft, source_reach),
               reads(ground.base, source_reach),
               reads(ground.raised, source_reach, some({&B::land_cover}))),
        [plan](const Tile& tile, Grid<glm::vec3>& out, const auto& matches, const auto& modelled,
               const auto& with_seam, const auto& draft, const auto& base, const auto& raised) {
          out = part_of(copy_ground(*plan, {matches.value, modelled.value, with_seam.value},
                                    draft.value, base.value, raised.value.land_cover, matches.rect),
                        matches.inside(tile.rect));
        });
  }

  // Mist in front of the ground in a pixel.
  if (in->has_mist) {
    picture.mist_sight = graph.add_tiles<MistSight>(
        whole_tiles("mist seen", mist_tile_px),
        grids_of(&MistSight::share, &MistSight::depth_m, &MistSight::light, &MistSight::altitude_m),
        inputs(reads(ground.crested, {}, some({&B::depth_m}))),
        [in](const Tile& tile, const auto& crested) {
          const World& world = *in->world;
          const MistView seen{*in->camera, world.deformation, &world.tracer,
                              world.view.sun_direction, in->pixels_per_unit};
          return see_mist(world.mist, seen, crested.value.depth_m, {tile.rect.x0, tile.rect.y0});
        });
    picture.mist_paint = graph.add_tiles<MistPaint>(
        whole_tiles("mist painted", mist_tile_px), grids_of(&MistPaint::share, &MistPaint::colour),
        inputs(reads(picture.mist_sight, around(mist_margin_px(in->strokes)))),
        [in](const Tile& tile, const auto& seen) {
          const SheetWindow position{.origin_px = seen.origin_px(),
                                     .sheet_px = in->size_px,
                                     .asked = seen.inside(tile.rect)};
          return paint_mist(seen.value, in->world->view.air, *in->palette, in->strokes, position,
                            in->run.progress);
        });
  }

  // Finishing strokes, far to near. Those of the sky, by far the longest, begin where sky is
  // visible.
  const StrokeLayers layers{
      .sky = true, .ground = plan == nullptr, .accents = true, .breaks = true, .upright = true};
  StrokeLayers below_sky = layers;
  below_sky.sky = false;
  const Reach reach =
      around(std::max(stroke_margin_px(below_sky, in->strokes), features.house_reach_px));
  const Reach sky_reach =
      around(std::max(stroke_margin_px(layers, in->strokes), features.house_reach_px));
  StageNode::Declaration strokes = view("strokes");
  strokes.work_bytes_per_pixel = stroke_work_bytes;
  strokes.condition =
      seen_in<GuidanceBuffers>(ground.crested, around(stroke_margin_px(layers, in->strokes)),
                               some({&B::depth_m}), shows_sky);
  picture.finished = graph.add_view<FinishedPaint>(
      std::move(strokes), untiled<FinishedPaint>(),
      inputs(reads(picture.copied), reads(picture.mist_paint),
             Reads<GuidanceBuffers>{.stage = ground.lit,
                                    .reach = reach,
                                    .wanted = some(stroke_channels()),
                                    .wide_reach = sky_reach},
             Reads<BasePicture>{.stage = ground.base, .reach = reach, .wide_reach = sky_reach},
             Reads<MistSight>{.stage = picture.mist_sight,
                              .reach = reach,
                              .wanted = with_grids(&MistSight::share),
                              .wide_reach = sky_reach},
             Reads<CrestShift>{.stage = features.empty() ? nullptr : ground.crests,
                               .reach = reach,
                               .wanted = with_grids(&CrestShift::rows),
                               .wide_reach = sky_reach}),
      [in, ice = ground.ice, layers, &features](
          const Tile& tile, FinishedPaint& out, const auto& copied, const auto& mist,
          const auto& lit, const auto& base, const auto& veil, const auto& crests) {
        StrokeLayers seen = layers;
        seen.sky = tile.wide;
        out = finish_paint({copied.value, mist.value, tile.rect},
                           {lit.value, base.value, veil.value.share, crests.value.rows, lit.rect},
                           {in->strokes, seen, features, ice->get(), in->size_px}, out.in_parts,
                           in->run.progress);
      });

  // A painter's style over everything: its colours first, then its strokes.
  if (in->style != nullptr) {
    const SheetStyle& style = *in->style;
    const auto styled = [&](const char* name) {
      return StageNode::Declaration{.name = name,
                                    .size_px = in->size_px,
                                    .tile_px = ground.base->declaration().tile_px,
                                    .work_bytes_per_pixel = style_work_bytes};
    };
    // A style reads far around its tiles: strokes are painted once.
    picture.below_style = graph.add_tiles<Grid<glm::vec3>>(
        styled("picture below the style"), one_grid<Grid<glm::vec3>>(),
        inputs(reads(picture.finished)),
        [](const Tile&, const auto& finished) { return finished.value.picture; });
    const Reach around_ground = around(style_preparation_margin_px(style.style, style.parameters));
    picture.style_ground = graph.add_tiles<StyleGround>(
        styled("style's ground"),
        grids_of(&StyleGround::colour, &StyleGround::smoothed, &StyleGround::along),
        inputs(reads(picture.below_style, around_ground),
               reads(ground.lit, around_ground,
                     some({&B::depth_m, &B::land_cover, &B::fall_line, &B::valley_height_m})),
               reads(picture.mist_sight, around_ground, with_grids(&MistSight::share))),
        [in](const Tile& tile, const auto& below, const auto& lit, const auto& veil) {
          return prepare_style(in->style->style, lit.value, below.value, veil.value.share,
                               in->style->seen(), lit.origin_px(), lit.inside(tile.rect));
        });
    const Reach around_strokes = around(style_laying_margin_px(style.style, style.parameters));
    picture.styled = graph.add_tiles<Grid<glm::vec3>>(
        styled("style"), one_grid<Grid<glm::vec3>>(),
        inputs(reads(picture.style_ground, around_strokes),
               reads(ground.lit, around_strokes, some({&B::depth_m, &B::land_cover, &B::tone}))),
        [in](const Tile& tile, const auto& prepared, const auto& lit) {
          return lay_style(in->style->style, lit.value, prepared.value, in->style->seen(),
                           lit.origin_px(), lit.inside(tile.rect));
        });
  }

  // Depth edges are softened, and layers are split.
  picture.picture = graph.add_view<SheetPicture>(
      view("panorama"), untiled<SheetPicture>(),
      inputs(reads_in_pieces(picture.finished, around(blend_margin_px)),
             reads_in_pieces(ground.lit, around(blend_margin_px)),
             reads_in_pieces(picture.styled, around(blend_margin_px))),
      [some](const Tile& tile, SheetPicture& out, const auto& finished, const auto& lit,
             const auto& styled) {
        const PixelRect window = finished.rect();
        const bool in_style = !styled.rect().empty();
        const PixelRect wanted = moved(tile.rect, -window.x0, -window.y0);
        FinishedPaint paint;
        paint.in_parts = out.layers.has_value();
        if (!in_style || paint.in_parts) finished.read_into(window, paint);
        if (in_style) {
          paint.picture = Grid<glm::vec3>(window.width(), window.height());
          styled.read_into(window, paint.picture);
        }
        GuidanceBuffers edges = some({&B::depth_m, &B::front})(window.width(), window.height());
        lit.read_into(window, edges);
        out.colour = part_of(blend_edges(paint.picture, edges), wanted);
        if (!out.layers) return;
        GuidanceBuffers about = some({&B::depth_m, &B::land_cover, &B::shadow, &B::tone})(
            tile.rect.width(), tile.rect.height());
        lit.read_into(tile.rect, about);
        const MistPaint mist =
            paint.mist.share.empty()
                ? MistPaint()
                : MistPaint{part_of(paint.mist.share, wanted), part_of(paint.mist.colour, wanted)};
        out.layers = cut_layers(part_of(paint.bare, wanted), mist, *paint.parts, wanted, about,
                                part_of(paint.haze, wanted), out.colour);
      });
  return picture;
}

SheetPicture with_layers(int, int) { return {{}, PictureLayers()}; }

}  // namespace belvedere
