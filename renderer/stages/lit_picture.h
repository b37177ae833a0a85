#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "base/run.h"
#include "renderer/graph/stage_graph.h"
#include "renderer/paint/base_picture.h"
#include "renderer/paint/palette.h"
#include "renderer/rock/rock_ground.h"
#include "renderer/rock/rock_relief.h"
#include "renderer/stages/ground_inputs.h"
#include "renderer/world/picture_parameters.h"
#include "renderer/world/world.h"

// Guidance buffers as products of stages: windows with some of the channels.

namespace belvedere {

// Parameters of the stages of a world's sheet, mean light included. All arguments must outlive
// them.
GroundInputs make_ground_inputs(const World& world, const SheetView& view, const Palette& palette,
                                const Run& run);

// A small picture made at once: traced channels with light and base picture, complete guidance
// buffers, and the base picture that strokes are painted on. Uses the stages of a sheet (stages.h),
// for one rectangle held in memory.
struct LitPicture {
  GuidanceBuffers guidance;  // tone and base included
  BasePicture base;
};
LitPicture make_lit_picture(const World& world, const Palette& palette, PixelRect region,
                            const Run& run);
// A lit picture of another view of the world, such as a reduced one.
LitPicture make_lit_picture(const World& world, const SheetView& view, const Palette& palette,
                            PixelRect region, const Run& run);

// The mean light (light_of_tone) over the sunlit ground of the picture, weighted by the luminance
// of the ground's own colour, so that colours times light divided by this are on average as light
// as the ground's own. Measured on a small view of the whole picture, the same for every part of a
// sheet.
double mean_light_of(const World& world, const Palette& palette);

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
