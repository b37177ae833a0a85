#pragma once

#include <string>
#include <vector>

#include "base/pixel_rect.h"
#include "renderer/graph/planes.h"
#include "renderer/sheet/work_folder.h"

namespace belvedere {

// The finished pieces of a part of the sheet, read as rows over its whole width.
struct JoinedPieces {
  const WorkFolder& work;
  std::vector<PixelRect> pieces;  // that cover the region, and perhaps more
  PixelRect region;               // px of the sheet

  // Rows [y0, y1) of the sheet of a product, into planes of the region's width and that many rows.
  // Error(input) where a piece is incomplete.
  void read(const std::string& product, int y0, int y1, const Planes& to) const;
};

}  // namespace belvedere
