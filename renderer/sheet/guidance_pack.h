#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/guidance_buffers.h"
#include "renderer/graph/tile_store.h"

namespace belvedere {

// Guidance in the form of its file: each component of each channel a plane of halves, floats or
// whole numbers, so that pieces that wait for the file take no more memory than it, without loss.
// Channels in the order of the table; empty ones are left out, and must be the same for all pieces
// of a sheet.
struct PackedGuidance {
  std::vector<std::vector<std::byte>> values;
  Planes planes;
};
PackedGuidance pack_guidance(const GuidanceBuffers& guidance);
// One pixel of each guidance channel of a sheet: those that the stages of tracing and light fill.
GuidanceBuffers sheet_guidance_like(glm::dvec3 origin_m);
// Planes of that many pixels to read packed rows into.
PackedGuidance blank_packed(const GuidanceBuffers& like, int width, int height);
// The values of `packed`, as numbers; `like` determines the channels.
GuidanceBuffers unpack_guidance(const PackedGuidance& packed, const GuidanceBuffers& like);

// The channels of a guidance file, by their names in the file ("Z", "landcover.id"); nothing: all
// of them. A vector is included whole: one of its components names it.
using GuidanceChoice = std::optional<std::vector<std::string>>;

// "Z,landcover.id", or "none" for no file. Error(usage) listing the available channels.
GuidanceChoice read_guidance_choice(const std::string& text);
// Empties the channels that are not chosen.
void keep_chosen(GuidanceBuffers& guidance, const GuidanceChoice& choice);

}  // namespace belvedere
