#pragma once

#include "base/guidance_buffers.h"
#include "renderer/graph/planes.h"

namespace belvedere {

// Guidance as its file holds it: each component of each channel a plane of halves, floats or whole numbers, so that pieces that wait for
// the file take no more room than it, and nothing is lost that the file would keep. Channels in the order of the table; empty ones are left
// out, and must be the same for all pieces of a sheet.
struct PackedGuidance {
  std::vector<std::vector<std::byte>> values;
  Planes planes;
};
PackedGuidance pack_guidance(const GuidanceBuffers& guidance);
// One pixel of each channel that a sheet's guidance has: what the stages of tracing and light fill.
GuidanceBuffers sheet_guidance_like(glm::dvec3 origin_m);
// Planes of that many pixels to read packed rows into.
PackedGuidance blank_packed(const GuidanceBuffers& like, int width, int height);
// What `packed` holds, as numbers; `like` says which channels there are.
GuidanceBuffers unpack_guidance(const PackedGuidance& packed, const GuidanceBuffers& like);

}  // namespace belvedere
