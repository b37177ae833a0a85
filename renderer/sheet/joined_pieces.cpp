#include "renderer/sheet/joined_pieces.h"

#include <algorithm>
#include <cstddef>

#include "renderer/sheet/piece_file.h"

namespace belvedere {
namespace {

Planes from_row(const Planes& planes, int row) {
  Planes rows = planes;
  for (Plane& plane : rows) plane.values += plane.row_bytes() * static_cast<std::size_t>(row);
  return rows;
}

}  // namespace

void JoinedPieces::read(const std::string& product, int y0, int y1, const Planes& to) const {
  for (const PixelRect& piece : pieces) {
    if (piece.y0 >= y1 || piece.y1 <= y0) continue;
    const int first = std::max(y0, piece.y0);
    read_piece_rows(work.path(product, piece), work.key(product, piece), first,
                    std::min(y1, piece.y1), region.x0, from_row(to, first - y0));
  }
}

}  // namespace belvedere
