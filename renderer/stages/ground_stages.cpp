#include "renderer/stages/stages.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/grid.h"
#include "renderer/close/close_relief.h"
#include "renderer/features/drawn_features.h"
#include "renderer/mist/mist_sight.h"
#include "renderer/paint/ground/base_surroundings.h"
#include "renderer/paint/guides.h"
#include "renderer/rock/rock_ground.h"
#include "renderer/stages/copied_ground.h"
#include "renderer/stages/ground_inputs.h"
#include "renderer/stages/lit_picture.h"
#include "renderer/stages/sheet_style.h"
#include "renderer/style/paint_style.h"
#include "renderer/trace/camera.h"
#include "texture/sheet/synthesis_tile.h"

namespace belvedere {
namespace {

using B = GuidanceBuffers;
using Channels = std::vector<GuidanceMember>;

// Measured, per pixel of a window while a stage works on it.
constexpr double light_work_bytes = 80.0;

WideView as_wide_view(const Window<GuidanceBuffers>& window) {
  return {window.value, window.scale, window.origin_px()};
}
WideView as_wide_view(const Window<GuidanceBuffers>& window, const Window<Grid<glm::vec2>>& fall) {
  WideView wide = as_wide_view(window);
  if (!fall.value.empty()) wide.smooth_fall = &fall.value;
  return wide;
}

// Shores are searched up and down, farther than anything else.
Reach base_reach(bool has_water, const BaseParameters& parameters) {
  const PixelRect reach = base_window({}, has_water, parameters);
  return {reach.x1, reach.y1};
}

bool shows_water(const GuidanceBuffers& guidance) {
  return std::find(guidance.land_cover.begin(), guidance.land_cover.end(), LandCoverClass::water) !=
         guidance.land_cover.end();
}

Channels guide_channels() {
  Channels channels = {&B::depth_m, &B::tone};
  for (const GuideKind& kind : guide_kinds())
    if (channel_of(kind.channel).maker == ChannelMaker::trace &&
        kind.channel != GuidanceMember(&B::depth_m))
      channels.push_back(kind.channel);
  return channels;
}

// Traced pixels of a tile: silhouettes and sky view read their neighbours.
GuidanceBuffers trace_tile(const GroundInputs& in, PixelRect tile) {
  const PixelRect window =
      intersection({0, 0, in.size_px.x, in.size_px.y}, grown(tile, guidance_margin_px()));
  GuidanceBuffers wide = trace_view(*in.world, in.view(), window, in.run);
  if (window == tile) return wide;
  GuidanceBuffers traced;
  traced.origin_m = wide.origin_m;
  for (const GuidanceMember& channel : channels_of(ChannelMaker::trace))
    std::visit(
        [&](auto grid) { traced.*grid = part_of(wide.*grid, moved(tile, -window.x0, -window.y0)); },
        channel);
  return traced;
}

// The channels that are present in `out`, of rays that are traced already.
void take_traced(const GuidanceBuffers& traced, PixelRect rect, GuidanceBuffers& out) {
  for (const GuidanceMember& channel : channels_of(ChannelMaker::trace))
    std::visit(
        [&](auto grid) {
          if (!(out.*grid).empty()) out.*grid = part_of(traced.*grid, rect);
        },
        channel);
}

}  // namespace

GroundStages add_ground_stages(StageGraph& graph, GroundInputs given, int tile_px) {
  const auto in = std::make_shared<const GroundInputs>(std::move(given));
  const double ppu = in->pixels_per_unit;
  const glm::dvec3 origin_m = in->world == nullptr ? glm::dvec3(0.0) : in->world->surface->origin;
  const auto tiles = [&](const char* name, double work_bytes = 0.0) {
    return StageNode::Declaration{.name = name,
                                  .size_px = in->size_px,
                                  .tile_px = tile_px,
                                  .work_bytes_per_pixel = work_bytes};
  };
  const auto view = [&](const char* name) {
    return StageNode::Declaration{.name = name, .size_px = in->size_px};
  };
  const auto channels = [&](Channels of) { return channel_format(std::move(of), origin_m); };
  const auto some = [&](Channels of) { return with_channels(std::move(of), origin_m); };
  GroundStages ground{.inputs = in};
  ground.ice = std::make_shared<const LazyValue<IcePlan>>(
      [in] { return make_ice_plan(*in->world, in->run); });

  // Primary rays, several per pixel, with cast shadows and sky view.
  ground.traced = in->traced
                      ? graph.add_view<GuidanceBuffers>(
                            view("traced"), channels(channels_of(ChannelMaker::trace)), inputs(),
                            [in](const Tile& tile, GuidanceBuffers& out) {
                              take_traced(*in->traced, tile.rect, out);
                            })
                      : graph.add_tiles<GuidanceBuffers>(
                            tiles("traced"), channels(channels_of(ChannelMaker::trace)), inputs(),
                            [in](const Tile& tile) { return trace_tile(*in, tile.rect); });

  // The same in larger pixels, one ray each: wide effects (ribs, forest lanes, spurs of rock) read
  // these.
  const auto from_afar = [&](const char* name, int factor, const Channels& of) {
    if (!in->wide_views || factor == 1) return ground.traced;
    StageNode::Declaration declared{
        .name = name, .size_px = (in->size_px + factor - 1) / factor, .scale = factor};
    declared.tile_px = std::max(64, tile_px / factor);
    const std::shared_ptr<const Camera> camera =
        in->camera == nullptr ? nullptr : make_reduced_camera(*in->camera, factor);
    return graph.add_tiles<GuidanceBuffers>(
        std::move(declared), channels(of), inputs(), [in, camera](const Tile& tile) {
          return trace_forms(*in->world, *camera, tile.rect, in->run);
        });
  };
  const Channels wide_channels = {&B::depth_m, &B::position_m, &B::land_cover, &B::fall_line};
  const Channels far_channels = {&B::depth_m, &B::land_cover, &B::fall_line, &B::normal,
                                 &B::footprint_m};
  ground.wide = from_afar("wide view", wide_factor(ppu), wide_channels);
  ground.far = from_afar("far view", rock_factor(ppu), far_channels);

  const Channels traced_channels = channels_of(ChannelMaker::trace);
  const Channels raised_channels = in->rock_relief
                                       ? joined(traced_channels, channels_of(ChannelMaker::relief))
                                       : traced_channels;
  ground.crested = ground.raised = ground.traced;
  if (in->rock_relief) {
    // Both read far around their tiles: what they need from there is made once.
    const int far_scale = ground.far->declaration().scale;
    if (far_scale == rock_factor(ppu))
      ground.fall = graph.add_tiles<Grid<glm::vec2>>(
          {.name = "fall lines",
           .size_px = ground.far->declaration().size_px,
           .scale = far_scale,
           .tile_px = ground.far->declaration().tile_px,
           .work_bytes_per_pixel = light_work_bytes},
          one_grid<Grid<glm::vec2>>(),
          inputs(reads(ground.far, around(smooth_fall_reach(ppu, far_scale)),
                       some({&B::depth_m, &B::fall_line}))),
          [ppu](const Tile& tile, const auto& far) {
            const PixelRect wanted = far.inside(tile.rect);
            return part_of(smooth_fall_lines(as_wide_view(far), ppu, wanted), wanted);
          });

    // Crests of rock get pinnacles and notches: each column is shifted up or down.
    ground.crests = graph.add_tiles<CrestShift>(
        tiles("crests", light_work_bytes), grids_of(&CrestShift::rows, &CrestShift::front),
        inputs(reads(ground.far, around(crest_view_margin_px(in->rock)), some(far_channels)),
               reads(ground.fall, around(crest_view_margin_px(in->rock))),
               reads(ground.traced, rows_around(crest_margin_px(ppu)),
                     some({&B::depth_m, &B::front, &B::land_cover, &B::footprint_m}))),
        [in](const Tile& tile, const auto& far, const auto& fall, const auto& near) {
          return shift_crests(near.value, as_wide_view(far, fall), in->rock, near.origin_px(),
                              near.inside(tile.rect));
        });
    ground.crested = graph.add_view<GuidanceBuffers>(
        view("crested"), channels(traced_channels),
        inputs(reads(ground.crests),
               reads_in_pieces(ground.traced, rows_around(crest_reach_px(ppu)))),
        [](const Tile& tile, GuidanceBuffers& out, const auto& crests, const auto& traced) {
          gather_shifted(traced, crests.value, tile.rect, out);
        });

    const int relief_margin_px = std::max(rock_margin_px(in->rock), close_margin_px(in->rock));
    // Relief of rock that a DEM does not contain, and the borders of rock that follow it.
    ground.relief = graph.add_tiles<RockRelief>(
        tiles("rock relief", light_work_bytes),
        grids_of(&RockRelief::land_cover, &RockRelief::fall_line, &RockRelief::height,
                 &RockRelief::facet, &RockRelief::tone, &RockRelief::cover),
        inputs(
            reads(ground.far, around(relief_margin_px), some(far_channels)),
            reads(ground.fall, around(relief_margin_px)),
            reads(ground.crested,
                  around(std::max(rock_near_margin_px(in->rock), close_near_margin_px(in->rock))),
                  some(rock_channels()))),
        [in](const Tile& tile, const auto& far, const auto& fall, const auto& near) {
          const PixelRect wanted = near.inside(tile.rect);
          const WideView wide = as_wide_view(far, fall);
          RockRelief relief = make_rock_relief(near.value, wide, in->rock, near.origin_px(),
                                               in->run.progress, wanted);
          add_close_relief(relief, near.value, wide, in->rock, near.origin_px(), in->run.progress,
                           wanted);
          return relief;
        });
    ground.raised = graph.add_view<GuidanceBuffers>(
        view("raised"), channels(raised_channels),
        inputs(reads_in_pieces(ground.crested), reads_in_pieces(ground.relief)),
        [](const Tile& tile, GuidanceBuffers& out, const auto& crested, const auto& relief) {
          crested.read_into(tile.rect, out);
          lay_relief(relief, tile.rect, out);
        });
  }

  const auto with_rock = [&](Channels of, const Channels& rock) {
    return some(in->rock_relief ? joined(std::move(of), rock) : std::move(of));
  };

  // Light as one number: sun with cast shadows, sky view, relief at several scales.
  ground.tone = graph.add_tiles<Grid<float>>(
      tiles("tone", light_work_bytes), one_grid<Grid<float>>(),
      inputs(reads(ground.wide, around(tone_margin_px(in->tone)), some(wide_channels)),
             reads(ground.raised, around(tone_near_margin_px(in->tone)),
                   with_rock({&B::depth_m, &B::position_m, &B::normal, &B::normal_detail,
                              &B::normal_smooth, &B::altitude_m, &B::land_cover, &B::shadow,
                              &B::sky_view, &B::slope_deg, &B::fall_line, &B::footprint_m,
                              &B::relief_s_m, &B::relief_m_m, &B::relief_l_m},
                             {&B::rock_tone}))),
      [in](const Tile& tile, const auto& wide, const auto& near) {
        return make_tone(near.value, as_wide_view(wide), in->tone, near.origin_px(),
                         in->run.progress, near.inside(tile.rect));
      });
  Channels lit_channels = raised_channels;
  lit_channels.push_back(&B::tone);
  ground.lit = graph.add_view<GuidanceBuffers>(
      view("lit"), channels(lit_channels),
      inputs(reads_in_pieces(ground.raised), reads_in_pieces(ground.tone)),
      [](const Tile& tile, GuidanceBuffers& out, const auto& raised, const auto& tone) {
        raised.read_into(tile.rect, out);
        if (!out.tone.empty()) tone.read_into(tile.rect, out.tone);
      });

  // Colour from ramps by class, altitude and tone, with air and water over it. Water searches up
  // and down for its shores.
  StageNode::Declaration base_tiles = tiles("base picture", light_work_bytes);
  base_tiles.condition =
      seen_in<GuidanceBuffers>(ground.raised, {}, some({&B::land_cover}), shows_water);
  ground.base = graph.add_tiles<BasePicture>(
      std::move(base_tiles),
      grids_of(&BasePicture::colour, &BasePicture::darker, &BasePicture::lighter,
               &BasePicture::accent, &BasePicture::tree_density, &BasePicture::haze),
      inputs(
          reads(ground.wide, around(base_margin_px(in->base)), some(wide_channels)),
          Reads<GuidanceBuffers>{
              .stage = ground.lit,
              .reach = base_reach(false, in->base),
              .wanted = with_rock({&B::depth_m, &B::position_m, &B::altitude_m, &B::land_cover,
                                   &B::fall_line, &B::slope_deg, &B::footprint_m, &B::normal_smooth,
                                   &B::relief_s_m, &B::relief_m_m, &B::relief_l_m,
                                   &B::valley_height_m, &B::rim_m, &B::built, &B::grain, &B::tone},
                                  {&B::rock_facet, &B::rock_cover}),
              .wide_reach = base_reach(true, in->base)}),
      [in](const Tile& tile, const auto& wide, const auto& near) {
        const PixelRect wanted = near.inside(tile.rect);
        const std::optional<WaterImage> image = trace_reflections(
            *in->world, in->view(), *in->palette, near.value, near.origin_px(), wanted);
        return make_base_picture(near.value, as_wide_view(wide), *in->palette, in->base,
                                 near.origin_px(), in->size_px, in->run.progress, wanted,
                                 image ? &*image : nullptr);
      });

  // Extent of strokes: gives borders of copied ground their shape.
  const int draft_margin_px = stroke_margin_px(draft_layers, in->strokes);
  ground.draft = graph.add_tiles<PaintDraft>(
      tiles("draft", stroke_work_bytes),
      grids_of(&PaintDraft::land_cover, &PaintDraft::base, &PaintDraft::under,
               &PaintDraft::under_share),
      inputs(reads(ground.lit, around(draft_margin_px), some(stroke_channels())),
             reads(ground.base, around(draft_margin_px))),
      [in, ice = ground.ice](const Tile& tile, const auto& lit, const auto& base) {
        return make_paint_draft(lit.value, base.value, in->strokes,
                                {.origin_px = lit.origin_px(),
                                 .sheet_px = in->size_px,
                                 .asked = lit.inside(tile.rect),
                                 .ice = &ice->get()},
                                in->run.progress);
      });

  // The guides of synthesis, and the buffers that users can write to files.
  ground.guides = graph.add_view<GuideStack>(
      view("guides"), untiled<GuideStack>(),
      inputs(reads(ground.draft, {}, with_grids(&PaintDraft::land_cover)),
             reads(ground.lit, {}, some(guide_channels()))),
      [](const Tile&, GuideStack& out, const auto& draft, const auto& lit) {
        out = make_guide_stack(lit.value, draft.value.land_cover);
      });
  ground.guidance = graph.add_view<GuidanceBuffers>(
      view("guidance"), channels(lit_channels),
      inputs(reads(ground.base, {}, with_grids(&BasePicture::colour)), reads_in_pieces(ground.lit)),
      [](const Tile& tile, GuidanceBuffers& out, const auto& base, const auto& lit) {
        lit.read_into(tile.rect, out);
        out.base = decode_srgb(base.value.colour);
      });
  return ground;
}

}  // namespace belvedere
