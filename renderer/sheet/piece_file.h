#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "renderer/graph/tile_store.h"

namespace belvedere {

// A finished rectangle of a product as a file that is either complete or absent: written under a
// temporary name, flushed to disk, renamed; it ends with the hash of all before it. Text head
// (format, job, product, rectangle, bytes per value of each plane), planes one after the other,
// hash.
struct PieceKey {
  std::string job;      // hash of everything that the pixels depend on: JobIdentity
  std::string product;  // "panorama", "guidance" …
  PixelRect rect;       // of the sheet
};

// Error(output) where it cannot be written.
void write_piece(const std::string& path, const PieceKey& key, const Planes& planes);
// Whether a file is that piece and its hash is right. Reads all of it; false where it does not
// exist.
bool is_whole_piece(const std::string& path, const PieceKey& key);
// Bytes per value of each plane and their offsets; for a piece that is complete. Error(input) where
// it cannot be read.
struct PieceLayout {
  std::vector<std::size_t> value_bytes;
  std::uint64_t begin = 0;
  std::uint64_t bytes = 0;  // of all planes
};
PieceLayout read_piece_layout(const std::string& path);
void read_piece_rows(const std::string& path, const PieceKey& key, int y0, int y1, int origin_x,
                     const Planes& to);
// A piece of one plane of bytes that is no picture, whole.
std::string read_piece_bytes(const std::string& path);

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

// "Z,landcover.id", "none" for no file, or "blender" for the file of compositing_file.h.
// Error(usage) listing the available channels.
GuidanceChoice read_guidance_choice(const std::string& text);
bool is_for_blender(const GuidanceChoice& choice);
// Empties the channels that are not chosen.
void keep_chosen(GuidanceBuffers& guidance, const GuidanceChoice& choice);

}  // namespace belvedere
