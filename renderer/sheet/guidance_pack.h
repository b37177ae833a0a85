#pragma once

#include "base/guidance_buffers.h"
#include "renderer/graph/planes.h"

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

}  // namespace belvedere
