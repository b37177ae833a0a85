#include "renderer/stages/guidance_windows.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <variant>

#include "base/parallel.h"

namespace belvedere {
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
