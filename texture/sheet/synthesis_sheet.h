#pragma once

#include <cstdint>

#include "base/pixel_rect.h"

namespace belvedere {

// Synthesis of a sheet of any size by parts (measured in docs/synthesis.md): the coarse levels are
// made whole, once, from a small view of the sheet, and form the plan; the finer ones are made in
// fixed tiles, each a function of the plan and of the guides in its window alone. So any part of
// the sheet consists of the tiles it touches, with the same bits in any order and process.
// No tile depends on another. The strips along the lines between tiles are made first, from the
// plan, and both adjoining tiles begin with them: corners of tiles, then the lines between two
// corners, then the tiles, each fitted to what is already fixed. The strips are narrow enough for
// each tile to make those around it again. The guarantees of synthesize.h hold in each tile with
// what is fixed around it; a piece across a line is counted so that it stays within the cap from
// end to end, unless it crosses the line more than once.

// The division of a sheet.
struct SynthesisSheet {
  int width = 0;  // pixels of the whole sheet
  int height = 0;
  int level = 0;  // of the plan: it is made at 1 / 2^level; finer levels in tiles. 0: the plan is
                  // the whole result
  int tile_px = 1024;  // side of the tiles, which begin at pixel (0, 0); a multiple of 8 × 2^level

  int columns() const { return (width + tile_px - 1) / tile_px; }
  int rows() const { return (height + tile_px - 1) / tile_px; }
  PixelRect tile(int column, int row) const;
  // Size of the small view: width / 2^level, rounded up.
  int plan_width() const { return ((width - 1) >> level) + 1; }
  int plan_height() const { return ((height - 1) >> level) + 1; }
};

inline constexpr int max_levels_in_tiles =
    6;  // the coarsest tile of 1024 pixels is then 32 pixels wide
inline constexpr std::int64_t default_plan_px = 4000000;
// The division whose small view is the largest of at most plan_px pixels. Throws Error(limit) if
// that would need more than 6 levels in tiles.
SynthesisSheet divide_sheet(int width, int height, std::int64_t plan_px = default_plan_px);

// At every level, in its own pixels: the width fixed on either side of a line between tiles, so
// that both tiles see a patch of radius 3 and most of its surroundings; and the width made around
// it, so that the fixed part has fitted neighbours. Even, so that windows of a level begin at whole
// pixels of the next coarser one.
inline constexpr int fixed_px = 4;
inline constexpr int around_px = 12;

// Margin around a tile in which guides are needed, pixels of the sheet.
int synthesis_margin_px(int level);
// The tile and its margin, within the sheet: where its guides are needed.
PixelRect synthesis_window(const SynthesisSheet& sheet, const PixelRect& tile);

}  // namespace belvedere
