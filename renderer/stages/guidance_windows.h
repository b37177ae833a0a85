#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/guidance_channels.h"
#include "renderer/graph/stage_graph.h"
#include "renderer/rock/crest_shift.h"
#include "renderer/rock/rock_relief.h"

// Guidance buffers as products of stages: windows with some of the channels.
namespace belvedere {

// Buffers with these channels, without values; positions are relative to origin_m.
Wanted<GuidanceBuffers> with_channels(std::vector<GuidanceMember> channels, glm::dvec3 origin_m);
// A product that keeps these channels.
ProductFormat<GuidanceBuffers> channel_format(std::vector<GuidanceMember> channels,
                                              glm::dvec3 origin_m);

// All channels of a maker, in the order of the table.
std::vector<GuidanceMember> channels_of(ChannelMaker maker);
std::vector<GuidanceMember> joined(std::vector<GuidanceMember> channels,
                                   std::span<const GuidanceMember> more);

// Fills the traced channels that are present in `out` with the pixels of a rectangle after the
// crest shift. `traced` extends crest_reach_px up and down. One channel at a time, because all
// together would be in memory twice.
void gather_shifted(const WindowReader<GuidanceBuffers>& traced, const CrestShift& shift,
                    PixelRect rect, GuidanceBuffers& out);

// Applies the relief of rock to its channels that are present in `out`.
void lay_relief(const WindowReader<RockRelief>& relief, PixelRect rect, GuidanceBuffers& out);

}  // namespace belvedere
