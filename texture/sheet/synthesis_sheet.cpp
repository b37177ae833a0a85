#include "texture/sheet/synthesis_sheet.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/error.h"

namespace belvedere {

SynthesisSheet divide_sheet(int width, int height, std::int64_t plan_px) {
  SynthesisSheet sheet{width, height};
  while (static_cast<std::int64_t>(sheet.plan_width()) * sheet.plan_height() > plan_px) {
    if (++sheet.level > max_levels_in_tiles) {
      throw Error(ErrorKind::limit, "plan of synthesis",
                  fmt::format("{} × {} pixels", width, height),
                  fmt::format("at most {} million with plans of {} pixels",
                              (plan_px << (2 * max_levels_in_tiles)) / 1000000, plan_px));
    }
  }
  return sheet;
}

PixelRect SynthesisSheet::tile(int column, int row) const {
  return {column * tile_px, row * tile_px, std::min(width, (column + 1) * tile_px),
          std::min(height, (row + 1) * tile_px)};
}

int synthesis_margin_px(int level) {
  // On the coarsest tiled level the area made around a line, and one pixel of the plan that halving
  // reads beyond.
  return level == 0 ? 0 : ((fixed_px + around_px) << (level - 1)) + (1 << level);
}

PixelRect synthesis_window(const SynthesisSheet& sheet, const PixelRect& tile) {
  const int margin = synthesis_margin_px(sheet.level);
  return {std::max(0, tile.x0 - margin), std::max(0, tile.y0 - margin),
          std::min(sheet.width, tile.x1 + margin), std::min(sheet.height, tile.y1 + margin)};
}

}  // namespace belvedere
