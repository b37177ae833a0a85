#pragma once

#include <cstdint>
#include <string>

#include "base/pixel_rect.h"
#include "renderer/graph/planes.h"

namespace belvedere {

// A finished rectangle of a product as a file that is whole or not there: written under a name of its own, brought to disk, renamed; its
// end is the hash of all before it. Text head (format, job, product, rectangle, bytes of a value in each plane), planes one after the
// other, hash.
struct PieceKey {
  std::string job;      // hash of all that the pixels hang on: JobIdentity
  std::string product;  // "panorama", "guidance" …
  PixelRect rect;       // of the sheet
};

// Error(output) where it cannot be written.
void write_piece(const std::string& path, const PieceKey& key, const Planes& planes);
// Whether a file is that piece and its hash is right. Reads all of it; one that is not there is not whole.
bool is_whole_piece(const std::string& path, const PieceKey& key);
// Bytes of the values in each plane and where they begin; for a piece that was found whole. Error(input) where it cannot be read.
struct PieceLayout {
  std::vector<std::size_t> value_bytes;
  std::uint64_t begin = 0;
  std::uint64_t bytes = 0;  // of all planes
};
PieceLayout read_piece_layout(const std::string& path);
// Rows [y0, y1) of the sheet of a piece, into grids whose pixel (0, 0) is the sheet's (origin_x, y0). Planes as in the file.
void read_piece_rows(const std::string& path, const PieceKey& key, int y0, int y1, int origin_x, const Planes& to);
// A piece of one plane of bytes that is no picture, whole.
std::string read_piece_bytes(const std::string& path);

}  // namespace belvedere
