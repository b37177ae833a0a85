#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/parallel.h"
#include "texture/synthesis/synthesize.h"

namespace belvedere {

// Synthesis of a sheet of any size by parts (measured in docs/synthesis.md): the coarse levels are made whole, once, from a small view of
// the sheet, and are the plan; the finer ones are made in fixed tiles, each a function of the plan and of the guides in its window alone.
// So any part of the sheet is the tiles it touches, with the same bits in any order and process.
//
// No tile looks at another. What lies along the lines between tiles is made first, from the plan, and both tiles beside a line begin
// with it: corners of tiles, then the lines between two corners, then the tiles, each fitted to what is fixed already. The strips are so
// narrow that each tile makes those around it anew.

// How a sheet is divided.
struct SynthesisSheet {
  int width = 0;  // pixels of the whole sheet
  int height = 0;
  int level = 0;       // of the plan: it is made at 1 / 2^level; finer levels in tiles. 0: the plan is the whole result
  int tile_px = 1024;  // side of the tiles, which begin at pixel (0, 0); a multiple of 8 × 2^level

  int columns() const { return (width + tile_px - 1) / tile_px; }
  int rows() const { return (height + tile_px - 1) / tile_px; }
  PixelRect tile(int column, int row) const;
  // Of the small view: width / 2^level, rounded up.
  int plan_width() const { return ((width - 1) >> level) + 1; }
  int plan_height() const { return ((height - 1) >> level) + 1; }
};

inline constexpr std::int64_t default_plan_px = 4000000;
// The division whose small view is the largest of at most plan_px pixels. Throws Error(limit) where that would need more than 6 levels in
// tiles.
SynthesisSheet divide_sheet(int width, int height, std::int64_t plan_px = default_plan_px);

// How far around a tile guides are needed, pixels of the sheet.
int synthesis_margin_px(int level);
// The tile and its margin, within the sheet: where its guides are needed.
PixelRect synthesis_window(const SynthesisSheet& sheet, const PixelRect& tile);

// What all tiles have in common: matches of the plan's level, and of the exemplars what the finer levels search. It owns its data.
class SynthesisPlan {
 public:
  struct Data;
  explicit SynthesisPlan(std::unique_ptr<Data> data);
  SynthesisPlan(SynthesisPlan&&) noexcept;
  SynthesisPlan& operator=(SynthesisPlan&&) noexcept;
  ~SynthesisPlan();

  const SynthesisSheet& sheet() const;
  const Data& data() const { return *data_; }
  Data& data() { return *data_; }

 private:
  std::unique_ptr<Data> data_;
};

// small_view: the guides of the whole sheet at 1 / 2^level, plan_width() × plan_height(). Parameters and notes are those of synthesize;
// where the level is 0, so are the matches.
SynthesisPlan plan_synthesis(const std::vector<Exemplar>& exemplars, const GuideStack& small_view, const SynthesisSheet& sheet,
                             const SynthesisParameters& parameters, Progress& progress);

// The matches of one tile of the sheet's division. `guides` are those of synthesis_window(sheet, tile) (of which nothing is read where the
// level is 0). The plan counts along which texels the tile uses, and is as before when the call ends: one tile at a time.
// progress.advance comes to 1 in all. Throws Error(usage) where the tile is none of the division or guides are missing or of another size.
MatchField synthesize_tile(SynthesisPlan& plan, const GuideStack& guides, const PixelRect& tile, Progress& progress);

// The plan without what can be made again from the exemplars: about 4 bytes a pixel of the small view.
std::vector<std::uint8_t> pack_plan(const SynthesisPlan& plan);
// The same plan in another process. Throws Error(input) where the bytes are no plan or damaged, or the exemplars are not those it was made
// with.
SynthesisPlan unpack_plan(const std::vector<std::uint8_t>& bytes, const std::vector<Exemplar>& exemplars);

// Memory that plan_synthesis needs at most beyond its arguments, and a tile beyond its plan and arguments, bytes; upper bounds.
std::size_t plan_bytes(std::size_t texels, std::size_t plan_pixels, int guides, bool with_depth);
std::size_t tile_bytes(const SynthesisSheet& sheet, int guides, bool with_depth);

}  // namespace belvedere
