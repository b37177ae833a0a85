#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/guidance_channels.h"
#include "renderer/graph/stage_graph.h"
#include "renderer/rock/crest_shift.h"
#include "renderer/rock/rock_relief.h"

// Guidance buffers as products of stages: windows that hold some of the channels.
namespace belvedere {

// Buffers that have these channels, without values; positions count from origin_m.
Wanted<GuidanceBuffers> with_channels(std::vector<GuidanceMember> channels, glm::dvec3 origin_m);
// A product that keeps these channels.
ProductFormat<GuidanceBuffers> channel_format(std::vector<GuidanceMember> channels, glm::dvec3 origin_m);

// All channels of a maker, in the order of the table.
std::vector<GuidanceMember> channels_of(ChannelMaker maker);
std::vector<GuidanceMember> joined(std::vector<GuidanceMember> channels, std::span<const GuidanceMember> more);

// Fills the traced channels that `out` has with the pixels of a rectangle as crests are shifted. `traced` reaches crest_reach_px up and
// down. One channel after the other: all at once would stand in memory twice.
void gather_shifted(const WindowReader<GuidanceBuffers>& traced, const CrestShift& shift, PixelRect rect, GuidanceBuffers& out);

// Lays the relief of rock over the channels that `out` has of it.
void lay_relief(const WindowReader<RockRelief>& relief, PixelRect rect, GuidanceBuffers& out);

}  // namespace belvedere
