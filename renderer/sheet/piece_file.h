#pragma once

#include <cstdint>
#include <string>

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
// A piece of one plane of bytes that is not a picture, whole.
void read_piece_rows(const std::string& path, const PieceKey& key, int y0, int y1, int origin_x,
                     const Planes& to);
// A piece of one plane of bytes that is no picture, whole.
std::string read_piece_bytes(const std::string& path);

}  // namespace belvedere
