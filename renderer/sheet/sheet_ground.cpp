#include "renderer/sheet/sheet_ground.h"

#include <algorithm>
#include <array>
#include <functional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "base/grid_part.h"
#include "base/parallel.h"
#include "renderer/paint/composite.h"
#include "renderer/paint/guides.h"
#include "renderer/sheet/sheet_ice.h"
#include "renderer/trace/camera_reduced.h"

namespace belvedere {
namespace {

using B = GuidanceBuffers;

// Grids of the traced channels in the order of the table; those that the buffers lack have no values.
Planes traced_planes(GuidanceBuffers& guidance) {
  Planes planes;
  for (const GuidanceChannel& channel : guidance_channels())
    if (channel.maker == ChannelMaker::trace)
      std::visit([&](auto member) { planes.push_back(plane_of(guidance.*member)); }, channel.member);
  for (Plane& plane : planes)
    if (plane.width == 0) plane.values = nullptr;
  return planes;
}

void make_channel(GuidanceBuffers& guidance, GuidanceMember member, int width, int height) {
  std::visit([&](auto grid) { guidance.*grid = typename std::decay_t<decltype(guidance.*grid)>(width, height); }, member);
}

// Several at once: new memory is first written by all threads, as it takes the system longer to give it than to fill it.
void make_channels(GuidanceBuffers& guidance, std::span<const GuidanceMember> members, int width, int height) {
  parallel_ranges(members.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) make_channel(guidance, members[i], width, height);
  });
}

GuidanceBuffers blank_traced(int width, int height) {
  std::vector<GuidanceMember> members;
  for (const GuidanceChannel& channel : guidance_channels())
    if (channel.maker == ChannelMaker::trace) members.push_back(channel.member);
  GuidanceBuffers guidance;
  make_channels(guidance, members, width, height);
  return guidance;
}

// The relief of rock in the order of its stage's grids; class and fall line are those that rock has changed.
constexpr std::initializer_list<GuidanceMember> relief_channels = {&B::land_cover, &B::fall_line, &B::rock_height,
                                                                   &B::rock_facet, &B::rock_tone, &B::rock_cover};

bool is_of_relief(const GuidanceMember& channel) {
  return std::find(relief_channels.begin(), relief_channels.end(), channel) != relief_channels.end();
}

Planes relief_planes(GuidanceBuffers& guidance) {
  Planes planes;
  for (const GuidanceMember& channel : relief_channels)
    std::visit([&](auto member) { planes.push_back(plane_of(guidance.*member)); }, channel);
  for (Plane& plane : planes)
    if (plane.width == 0) plane.values = nullptr;
  return planes;
}

// What a WideView holds.
constexpr std::initializer_list<GuidanceMember> wide_channels = {&B::depth_m, &B::position_m, &B::land_cover, &B::fall_line};
// What rock is looked at with.
constexpr std::initializer_list<GuidanceMember> far_channels = {&B::depth_m, &B::land_cover, &B::fall_line, &B::normal, &B::footprint_m};

GuidanceBuffers blank_with(std::initializer_list<GuidanceMember> channels, int width, int height) {
  GuidanceBuffers guidance;
  make_channels(guidance, {channels.begin(), channels.size()}, width, height);
  return guidance;
}

Planes wide_planes(GuidanceBuffers& g) {
  return {plane_of(g.depth_m), plane_of(g.position_m), plane_of(g.land_cover), plane_of(g.fall_line)};
}
Planes far_planes(GuidanceBuffers& g) {
  return {plane_of(g.depth_m), plane_of(g.land_cover), plane_of(g.fall_line), plane_of(g.normal), plane_of(g.footprint_m)};
}

// Side of the tiles of the wide view, in its own pixels.
int wide_tile_px(int tile_px, int factor) { return std::max(64, tile_px / factor); }

template <class Product, class Values>
std::function<void()> maker_of(Product& product, Values Product::*grid, int width, int height) {
  return [&product, grid, width, height] { product.*grid = Values(width, height); };
}

template <class Product, class... Grids>
typename SheetStage<Product>::Making making_of(std::function<Product(PixelRect)> make, Grids Product::*... grids) {
  return {.make = std::move(make),
          .blank =
              [grids...](int width, int height) {
                Product product;
                const std::array<std::function<void()>, sizeof...(Grids)> make_grids = {maker_of(product, grids, width, height)...};
                parallel_ranges(make_grids.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
                  for (std::size_t i = begin; i != end; ++i) make_grids[i]();
                });
                return product;
              },
          .planes = [grids...](Product& product) { return Planes{plane_of(product.*grids)...}; }};
}

}  // namespace

std::initializer_list<GuidanceMember> stroke_channels() {
  static const std::initializer_list<GuidanceMember> channels = {&B::depth_m,   &B::position_m,  &B::land_cover, &B::fall_line,
                                                                 &B::slope_deg, &B::footprint_m, &B::relief_s_m, &B::built,
                                                                 &B::grain,     &B::rock_facet};
  return channels;
}

SheetGround::SheetGround(const World& world, const SheetView& view, const Palette& palette, TileStore::Place& place, const Run& run,
                         int tile_px)
    : world_(world),
      view_(view),
      palette_(palette),
      run_(run),
      place_(place),
      rock_parameters_(to_rock_parameters(world, palette, view)),
      tone_parameters_(to_tone_parameters(world, palette, view)),
      base_parameters_(to_base_parameters(world, view, palette)),
      strokes_(to_stroke_parameters(world, palette, view)),
      factor_(wide_factor(view.pixels_per_unit)),
      wide_camera_(make_reduced_camera(view.camera, factor_)),
      far_factor_(rock_factor(view.pixels_per_unit)),
      far_camera_(make_reduced_camera(view.camera, far_factor_)),
      traced_(place, view.camera.size().x, view.camera.size().y, tile_px,
              {.make = [this](PixelRect tile) { return make_traced(tile); }, .blank = blank_traced, .planes = traced_planes}),
      wide_(place, wide_camera_->size().x, wide_camera_->size().y, wide_tile_px(tile_px, factor_),
            {.make = [this](PixelRect tile) { return trace_forms(world_, *wide_camera_, tile, run_); },
             .blank = [](int width, int height) { return blank_with(wide_channels, width, height); },
             .planes = wide_planes}),
      far_(place, far_camera_->size().x, far_camera_->size().y, wide_tile_px(tile_px, far_factor_),
           {.make = [this](PixelRect tile) { return trace_forms(world_, *far_camera_, tile, run_); },
            .blank = [](int width, int height) { return blank_with(far_channels, width, height); },
            .planes = far_planes}),
      crests_(place, view.camera.size().x, view.camera.size().y, tile_px,
              making_of<CrestShift>([this](PixelRect tile) { return make_crests(tile); }, &CrestShift::rows, &CrestShift::front)),
      relief_(place, view.camera.size().x, view.camera.size().y, tile_px,
              making_of<RockRelief>([this](PixelRect tile) { return make_relief(tile); }, &RockRelief::land_cover, &RockRelief::fall_line,
                                    &RockRelief::height, &RockRelief::facet, &RockRelief::tone, &RockRelief::cover)),
      tone_(place, view.camera.size().x, view.camera.size().y, tile_px,
            {.make = [this](PixelRect tile) { return make_tone_tile(tile); },
             .blank = [](int width, int height) { return Grid<float>(width, height); },
             .planes = [](Grid<float>& tone) { return Planes{plane_of(tone)}; }}),
      base_(place, view.camera.size().x, view.camera.size().y, tile_px,
            making_of<BasePicture>([this](PixelRect tile) { return make_base(tile); }, &BasePicture::colour, &BasePicture::darker,
                                   &BasePicture::lighter, &BasePicture::accent, &BasePicture::tree_density, &BasePicture::haze)),
      draft_(place, view.camera.size().x, view.camera.size().y, tile_px,
             making_of<PaintDraft>([this](PixelRect tile) { return make_draft(tile); }, &PaintDraft::land_cover, &PaintDraft::base,
                                   &PaintDraft::under, &PaintDraft::under_share)) {}

GuidanceBuffers SheetGround::make_traced(PixelRect tile) {
  const PixelRect window = intersection(sheet(), grown(tile, guidance_margin_px()));
  GuidanceBuffers wide = trace_view(world_, view_, window, run_);
  GuidanceBuffers traced;
  traced.origin_m = wide.origin_m;
  for (const GuidanceChannel& channel : guidance_channels())
    if (channel.maker == ChannelMaker::trace)
      std::visit([&](auto grid) { traced.*grid = part_of(wide.*grid, moved(tile, -window.x0, -window.y0)); }, channel.member);
  return traced;
}

void SheetGround::prepare_guidance(PixelRect rect, bool with_relief, bool with_tone) {
  if (with_tone) tone_.prepare(rect);
  if (with_relief) relief_.prepare(rect);
  prepare_crested(rect);
}

GuidanceBuffers SheetGround::read_guidance(PixelRect rect, std::initializer_list<GuidanceMember> channels, bool with_tone) {
  const bool with_relief = std::any_of(channels.begin(), channels.end(), is_of_relief);
  prepare_guidance(rect, with_relief, with_tone);
  GuidanceBuffers guidance;
  guidance.origin_m = world_.surface.origin;
  make_channels(guidance, {channels.begin(), channels.size()}, rect.width(), rect.height());
  read_crested(rect, guidance);
  if (with_relief) relief_.read_into(rect, relief_planes(guidance));
  if (with_tone) guidance.tone = tone_.read(rect);
  return guidance;
}

GuidanceBuffers SheetGround::read_all_guidance(PixelRect rect) {
  prepare_base(rect);
  prepare_guidance(rect, true, true);
  GuidanceBuffers guidance = blank_traced(rect.width(), rect.height());
  guidance.origin_m = world_.surface.origin;
  read_crested(rect, guidance);
  take_relief(guidance, relief_.read(rect));
  guidance.tone = tone_.read(rect);
  guidance.base = decode_srgb(base_.read(rect).colour);
  return guidance;
}

SheetGround::Wide SheetGround::look_from_afar(PixelRect rect, int factor, SheetStage<GuidanceBuffers>& stage,
                                              std::initializer_list<GuidanceMember> channels) {
  Wide wide;
  if (factor == 1) {
    rect = intersection(sheet(), rect);
    wide.seen = blank_with(channels, rect.width(), rect.height());
    traced_.read_into(rect, traced_planes(wide.seen));
  } else {
    rect = intersection(stage.sheet(), wide_rect(rect, factor));
    wide.seen = stage.read(rect);
  }
  wide.seen.origin_m = world_.surface.origin;
  wide.origin_px = {rect.x0, rect.y0};
  return wide;
}

SheetGround::Wide SheetGround::read_wide(PixelRect rect) { return look_from_afar(rect, factor_, wide_, wide_channels); }

SheetGround::Wide SheetGround::read_far(PixelRect rect) { return look_from_afar(rect, far_factor_, far_, far_channels); }

CrestShift SheetGround::make_crests(PixelRect tile) {
  const double ppu = view_.pixels_per_unit;
  const PixelRect window = intersection(sheet(), {tile.x0, tile.y0 - crest_margin_px(ppu), tile.x1, tile.y1 + crest_margin_px(ppu)});
  traced_.prepare(window);
  const Wide far = read_far(grown(tile, crest_view_margin_px(rock_parameters_)));
  GuidanceBuffers guidance = blank_with({&B::depth_m, &B::front, &B::land_cover, &B::footprint_m}, window.width(), window.height());
  traced_.read_into(window, traced_planes(guidance));
  return shift_crests(guidance, {far.seen, far_factor_, far.origin_px}, rock_parameters_, {window.x0, window.y0},
                      moved(tile, -window.x0, -window.y0));
}

// Where crests are made, the rows above and below that they may be gathered from are traced already: crest_margin_px is the longer reach.
void SheetGround::prepare_crested(PixelRect rect) {
  crests_.prepare(rect);
  traced_.prepare(rect);
}

void SheetGround::read_crested(PixelRect rect, GuidanceBuffers& guidance) {
  const CrestShift shift = crests_.read(rect);
  if (std::all_of(shift.rows.begin(), shift.rows.end(), [](std::int16_t rows) { return rows == 0; })) {
    traced_.read_into(rect, traced_planes(guidance));
    if (!guidance.front.empty()) guidance.front = shift.front;
    return;
  }
  const int reach = crest_reach_px(view_.pixels_per_unit);
  const PixelRect window = intersection(sheet(), {rect.x0, rect.y0 - reach, rect.x1, rect.y1 + reach});
  // One channel after the other: all at once would stand in memory twice.
  for (const GuidanceChannel& channel : guidance_channels())
    std::visit(
        [&](auto member) {
          if (channel.maker != ChannelMaker::trace || (guidance.*member).empty()) return;
          GuidanceBuffers traced;
          make_channel(traced, channel.member, window.width(), window.height());
          traced_.read_into(window, traced_planes(traced));
          guidance.*member = std::move(gather_rows(traced, shift, moved(rect, -window.x0, -window.y0)).*member);
        },
        channel.member);
}

RockRelief SheetGround::make_relief(PixelRect tile) {
  const PixelRect window = intersection(sheet(), grown(tile, rock_near_margin_px(rock_parameters_)));
  prepare_crested(window);
  const Wide far = read_far(grown(tile, rock_margin_px(rock_parameters_)));
  GuidanceBuffers guidance;
  guidance.origin_m = world_.surface.origin;
  const std::initializer_list<GuidanceMember> channels = rock_channels();
  make_channels(guidance, {channels.begin(), channels.size()}, window.width(), window.height());
  read_crested(window, guidance);
  return make_rock_relief(guidance, {far.seen, far_factor_, far.origin_px}, rock_parameters_, {window.x0, window.y0}, run_.progress,
                          moved(tile, -window.x0, -window.y0));
}

Grid<float> SheetGround::make_tone_tile(PixelRect tile) {
  const PixelRect window = intersection(sheet(), grown(tile, tone_near_margin_px(tone_parameters_)));
  prepare_guidance(window, true, false);
  const Wide wide = read_wide(grown(tile, tone_margin_px(tone_parameters_)));
  const GuidanceBuffers guidance = read_guidance(
      window,
      {&B::depth_m, &B::position_m, &B::normal, &B::normal_detail, &B::normal_smooth, &B::altitude_m, &B::land_cover, &B::shadow,
       &B::sky_view, &B::slope_deg, &B::fall_line, &B::footprint_m, &B::relief_s_m, &B::relief_m_m, &B::relief_l_m, &B::rock_tone},
      false);
  return make_tone(guidance, {wide.seen, factor_, wide.origin_px}, tone_parameters_, {window.x0, window.y0}, run_.progress,
                   moved(tile, -window.x0, -window.y0));
}

bool SheetGround::shows_water(PixelRect rect) {
  const Grid<LandCoverClass> shown = read_guidance(rect, {&B::land_cover}, false).land_cover;
  place_.maker_holds = false;  // it is let go
  return std::find(shown.begin(), shown.end(), LandCoverClass::water) != shown.end();
}

BasePicture SheetGround::make_base(PixelRect tile) {
  const bool has_water = shows_water(tile);
  const PixelRect window = intersection(sheet(), base_window(tile, has_water, base_parameters_));
  prepare_guidance(window, true, true);
  const Wide wide = read_wide(grown(tile, base_margin_px(base_parameters_)));
  const GuidanceBuffers guidance = read_guidance(window,
                                                 {&B::depth_m, &B::position_m, &B::altitude_m, &B::land_cover, &B::fall_line, &B::slope_deg,
                                                  &B::footprint_m, &B::normal_smooth, &B::relief_s_m, &B::relief_m_m, &B::relief_l_m,
                                                  &B::valley_height_m, &B::rim_m, &B::built, &B::grain, &B::rock_facet, &B::rock_cover},
                                                 true);
  const PixelRect wanted = moved(tile, -window.x0, -window.y0);
  const glm::ivec2 origin_px{window.x0, window.y0};
  const std::optional<WaterImage> image = see_mirrored(world_, view_, palette_, guidance, origin_px, wanted);
  return make_base_picture(guidance, {wide.seen, factor_, wide.origin_px}, palette_, base_parameters_, origin_px, view_.camera.size(),
                           run_.progress, wanted, image ? &*image : nullptr);
}

PaintDraft SheetGround::make_draft(PixelRect tile) {
  const PixelRect window = intersection(sheet(), grown(tile, stroke_margin_px(draft_layers, strokes_)));
  const PixelRect wanted = moved(tile, -window.x0, -window.y0);
  prepare_base(window);
  const GuidanceBuffers guidance = read_guidance(window, stroke_channels(), true);
  const BasePicture base = base_.read(window);
  const SheetWindow place{.origin_px = {window.x0, window.y0}, .sheet_px = view_.camera.size(), .asked = wanted, .ice = &ice()};
  const Painting painting = paint_strokes(base.colour, guidance, base, draft_layers, strokes_, run_.progress, place);
  const PaintedClasses classes = find_painted_classes(painting.sources, guidance, base.colour);
  PaintDraft draft{part_of(classes.land_cover, wanted), part_of(classes.base, wanted), part_of(painting.under, wanted),
                   part_of(painting.under_share, wanted)};
  const auto width = static_cast<std::uint32_t>(window.width());
  for (std::uint32_t& from : draft.under)
    from = sheet_place(window.x0 + static_cast<int>(from % width), window.y0 + static_cast<int>(from / width));
  return draft;
}

GuideStack SheetGround::read_guides(PixelRect rect) {
  draft_.prepare(rect);
  prepare_guidance(rect, true, true);
  GuidanceBuffers guidance;
  guidance.origin_m = world_.surface.origin;
  make_channel(guidance, &B::depth_m, rect.width(), rect.height());
  for (const GuideKind& kind : guide_kinds())
    if (channel_of(kind.channel).maker == ChannelMaker::trace) make_channel(guidance, kind.channel, rect.width(), rect.height());
  read_crested(rect, guidance);
  if (!guidance.fall_line.empty()) relief_.read_into(rect, relief_planes(guidance));
  guidance.tone = tone_.read(rect);
  return make_guide_stack(guidance, draft_.read(rect).land_cover);
}

const IcePlan& SheetGround::ice() {
  if (!ice_) ice_ = make_ice_plan(world_, run_);
  return *ice_;
}

void SheetGround::keep_only(const Asked& still) {
  const double ppu = view_.pixels_per_unit;
  // From the last stage to the first, each with what those after it look at.
  const PixelRect drafted = intersection(sheet(), still.draft);
  const PixelRect painted = around_both(still.base, drafted.empty() ? drafted : grown(drafted, draft_reach_px()));
  const PixelRect lit = around_both(still.guidance, base_window(painted, true, base_parameters_));
  const PixelRect raised = grown(lit, tone_near_margin_px(tone_parameters_));
  const PixelRect crested = grown(raised, rock_near_margin_px(rock_parameters_));
  const int rows = std::max(crest_margin_px(ppu), crest_reach_px(ppu));
  const PixelRect wide = around_both(grown(painted, base_margin_px(base_parameters_)), grown(lit, tone_margin_px(tone_parameters_)));
  const PixelRect far =
      around_both(grown(raised, rock_margin_px(rock_parameters_)), grown(crested, crest_view_margin_px(rock_parameters_)));
  PixelRect traced{crested.x0, crested.y0 - rows, crested.x1, crested.y1 + rows};
  if (factor_ == 1) traced = around_both(traced, wide);
  if (far_factor_ == 1) traced = around_both(traced, far);
  traced_.keep_only(traced);
  wide_.keep_only(wide_rect(wide, factor_));
  far_.keep_only(wide_rect(far, far_factor_));
  crests_.keep_only(crested);
  relief_.keep_only(raised);
  tone_.keep_only(lit);
  base_.keep_only(painted);
  draft_.keep_only(drafted);
}

int SheetGround::draft_reach_px() const { return stroke_margin_px(draft_layers, strokes_); }

}  // namespace belvedere
