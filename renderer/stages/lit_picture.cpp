#include "renderer/stages/lit_picture.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>
#include <variant>

#include "base/parallel.h"
#include "renderer/image/srgb.h"
#include "renderer/stages/stages.h"
#include "renderer/trace/camera.h"

namespace belvedere {
namespace {

constexpr int measured_width_px = 480;
constexpr double no_air_m = 1e9;  // air that begins beyond everything

// Luminance of encoded sRGB, linear: the Y of IEC 61966-2-1.
double luminance_of(const glm::vec3& encoded) {
  const auto linear = [](float value) { return srgb_decoded(static_cast<double>(value)); };
  return 0.2126 * linear(encoded.x) + 0.7152 * linear(encoded.y) + 0.0722 * linear(encoded.z);
}

// Panels of example sheets are small at any print size, so they read only their own pixels.
LitPicture make_at_once(GroundInputs inputs, PixelRect region) {
  inputs.wide_views = false;
  TileStore::Place memory{.folder = {}, .memory_bytes = std::numeric_limits<std::uint64_t>::max()};
  Progress& progress = inputs.run.progress;
  StageGraph graph(memory, progress);
  const GroundStages ground =
      add_ground_stages(graph, std::move(inputs), std::max({64, region.x1, region.y1}));
  const StageGraph::Request all[] = {{ground.guidance, region}};
  graph.keep_only(all);
  LitPicture picture;
  picture.guidance = ground.guidance->read(region);
  picture.base = ground.base->read(region);
  return picture;
}

}  // namespace

GroundInputs make_ground_inputs(const World& world, const SheetView& view, const Palette& palette,
                                const Run& run) {
  GroundInputs inputs = make_unlit_inputs(world, view, palette, run);
  if (world.scene.light.model == "product") inputs.base.mean_light = mean_light_of(world, palette);
  return inputs;
}

LitPicture make_lit_picture(const World& world, const Palette& palette, PixelRect region,
                            const Run& run) {
  return make_lit_picture(world, view_of(world), palette, region, run);
}

LitPicture make_lit_picture(const World& world, const SheetView& view, const Palette& palette,
                            PixelRect region, const Run& run) {
  return make_at_once(make_ground_inputs(world, view, palette, run), region);
}

double mean_light_of(const World& world, const Palette& palette) {
  const int factor = std::max(1, world.camera->size().x / measured_width_px);
  const std::unique_ptr<const Camera> camera = make_reduced_camera(*world.camera, factor);
  GroundInputs inputs = make_unlit_inputs(world, reduced_view(world, *camera, factor), palette, {});
  inputs.base.mean_light = 1.0;
  inputs.base.air.from_m = no_air_m;
  inputs.base.air.rim_fade_m = 0.0;
  const glm::ivec2 size = camera->size();
  const LitPicture picture = make_at_once(std::move(inputs), {0, 0, size.x, size.y});
  const GuidanceBuffers& g = picture.guidance;
  double lit = 0.0;
  double own = 0.0;
  for (std::size_t i = 0; i < g.depth_m.size(); ++i) {
    if (g.is_sky(i) || g.land_cover[i] == LandCoverClass::water || g.shadow[i] <= 0.5F) continue;
    const double luminance = luminance_of(picture.base.colour[i]);
    lit += luminance;
    own += luminance / static_cast<double>(light_of_tone(g.tone[i]));
  }
  return own > 0.0 ? lit / own : static_cast<double>(light_of_tone(middle_tone));
}

namespace {

Planes planes_of(GuidanceBuffers& guidance, const std::vector<GuidanceMember>& channels) {
  Planes planes;
  planes.reserve(channels.size());
  for (const GuidanceMember& channel : channels)
    std::visit([&](auto member) { planes.push_back(plane_of(guidance.*member)); }, channel);
  return planes;
}

bool is_empty(const GuidanceBuffers& guidance, const GuidanceMember& channel) {
  return std::visit([&](auto member) { return (guidance.*member).empty(); }, channel);
}

// The relief's grids are swapped with those of the buffers meanwhile.
void swap_relief(RockRelief& relief, GuidanceBuffers& guidance) {
  std::swap(relief.land_cover, guidance.land_cover);
  std::swap(relief.fall_line, guidance.fall_line);
  std::swap(relief.height, guidance.rock_height);
  std::swap(relief.facet, guidance.rock_facet);
  std::swap(relief.tone, guidance.rock_tone);
  std::swap(relief.cover, guidance.rock_cover);
}

}  // namespace

Wanted<GuidanceBuffers> with_channels(std::vector<GuidanceMember> channels, glm::dvec3 origin_m) {
  return [channels = std::move(channels), origin_m](int width, int height) {
    GuidanceBuffers guidance;
    guidance.origin_m = origin_m;
    // In parallel: page faults of new memory take longer than filling it.
    parallel_ranges(channels.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i)
        std::visit(
            [&](auto grid) {
              guidance.*grid = std::decay_t<decltype(guidance.*grid)>(width, height);
            },
            channels[i]);
    });
    return guidance;
  };
}

ProductFormat<GuidanceBuffers> channel_format(std::vector<GuidanceMember> channels,
                                              glm::dvec3 origin_m) {
  return {
      .blank = with_channels(channels, origin_m),
      .planes = [channels](GuidanceBuffers& guidance) { return planes_of(guidance, channels); }};
}

std::vector<GuidanceMember> channels_of(ChannelMaker maker) {
  std::vector<GuidanceMember> channels;
  for (const GuidanceChannel& channel : guidance_channels())
    if (channel.maker == maker) channels.push_back(channel.member);
  return channels;
}

std::vector<GuidanceMember> joined(std::vector<GuidanceMember> channels,
                                   std::span<const GuidanceMember> more) {
  channels.insert(channels.end(), more.begin(), more.end());
  return channels;
}

void gather_shifted(const WindowReader<GuidanceBuffers>& traced, const CrestShift& shift,
                    PixelRect rect, GuidanceBuffers& out) {
  if (std::all_of(shift.rows.begin(), shift.rows.end(),
                  [](std::int16_t rows) { return rows == 0; })) {
    traced.read_into(rect, out);
    if (!out.front.empty()) out.front = shift.front;
    return;
  }
  const PixelRect window = traced.rect();
  for (const GuidanceMember& channel : channels_of(ChannelMaker::trace)) {
    if (is_empty(out, channel)) continue;
    GuidanceBuffers unshifted =
        with_channels({channel}, out.origin_m)(window.width(), window.height());
    traced.read_into(window, unshifted);
    GuidanceBuffers gathered = gather_rows(unshifted, shift, moved(rect, -window.x0, -window.y0));
    std::visit([&](auto member) { out.*member = std::move(gathered.*member); }, channel);
  }
}

void lay_relief(const WindowReader<RockRelief>& relief, PixelRect rect, GuidanceBuffers& out) {
  RockRelief laid;
  swap_relief(laid, out);
  relief.read_into(rect, laid);
  swap_relief(laid, out);
}

}  // namespace belvedere
