#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "base/pixel_rect.h"
#include "base/progress.h"
#include "texture/synthesis/exemplar.h"
#include "texture/synthesis/synth_setup.h"

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
  // Of the small view: width / 2^level, rounded up.
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

struct SynthesisPlanData;  // plan_data.h

// Shared by all tiles: matches of the plan's level, and the parts of the exemplars that the finer
// levels search. It owns its data.
class SynthesisPlan {
 public:
  explicit SynthesisPlan(std::unique_ptr<SynthesisPlanData> data);
  SynthesisPlan(SynthesisPlan&&) noexcept;
  SynthesisPlan& operator=(SynthesisPlan&&) noexcept;
  ~SynthesisPlan();

  const SynthesisSheet& sheet() const;
  const SynthesisPlanData& data() const { return *data_; }
  SynthesisPlanData& data() { return *data_; }

 private:
  std::unique_ptr<SynthesisPlanData> data_;
};

// small_view: the guides of the whole sheet at 1 / 2^level, plan_width() × plan_height().
// Parameters and notes as for synthesize; matches are final if the level is 0.
SynthesisPlan plan_synthesis(const std::vector<Exemplar>& exemplars, const GuideStack& small_view,
                             const SynthesisSheet& sheet, const SynthesisParameters& parameters,
                             Progress& progress);

// The plan without what can be recomputed from the exemplars: about 4 bytes per pixel of the small
// view.
std::vector<std::uint8_t> pack_plan(const SynthesisPlan& plan);
// The same plan in another process. Throws Error(input) if the bytes are not a plan or damaged, or
// the exemplars are not those it was made with.
SynthesisPlan unpack_plan(const std::vector<std::uint8_t>& bytes,
                          const std::vector<Exemplar>& exemplars);

// Matches of a level in a rectangle of its picture.
struct LevelMatches {
  PixelRect rect;
  std::vector<std::uint32_t> texels;
  std::uint32_t at(int x, int y) const {
    return texels[static_cast<std::size_t>(y - rect.y0) * static_cast<std::size_t>(rect.width()) +
                  static_cast<std::size_t>(x - rect.x0)];
  }
  bool contains(int x, int y) const {
    return x >= rect.x0 && y >= rect.y0 && x < rect.x1 && y < rect.y1;
  }
};

// An area that is made in one go: a corner, a line between corners or a tile. Its rectangle is
// empty where it has no width.
struct SynthesisArea {
  PixelRect rect;  // of the sheet
  bool across_x =
      false;  // a vertical line, or a corner: made with neighbours to the left and right
  bool across_y = false;
};
struct MadeArea {
  SynthesisArea area;
  std::uint64_t guides = 0;  // digest of those it was made with
  std::vector<LevelMatches> levels;
};

// Some of the corners and lines that were made last: neighbouring tiles begin with the same ones. A
// line of three levels takes 230 KB.
class MadeBetweenTiles {
 public:
  std::shared_ptr<const MadeArea> find(const PixelRect& rect, std::uint64_t guides) const;
  void keep(std::shared_ptr<const MadeArea> made);
  std::size_t count() const { return made_.size(); }

 private:
  std::deque<std::shared_ptr<const MadeArea>> made_;  // oldest first
};

// The content of a plan; only for code that makes, packs and uses plans.
struct SynthesisPlanData {
  SynthesisSheet sheet;
  synth::Setup setup;
  std::vector<std::uint32_t>
      matches;  // of the plan's level, row by row: texel of exemplars[level], or its nowhere
  synth::TexelDemand demand;                            // of the plan's level
  std::vector<std::vector<std::uint8_t>> usual_errors;  // by finer level
  std::vector<synth::Plane>
      exemplars;  // levels 0 … plan; of finer levels the pictures, of the plan's the positions only
  std::vector<std::shared_ptr<synth::LevelSource>> sources;  // by finer level
  std::uint64_t digest = 0;                                  // of the exemplars
  MadeBetweenTiles between_tiles;  // not part of the plan: derived from it
};

// Of everything that synthesis reads from the exemplars.
std::uint64_t digest_of(const synth::Plane& exemplars);
// The part of the plan that is made from the exemplars and the counts of the small view. planes: at
// least levels 0 … the plan's.
void make_sources(SynthesisPlanData& data, std::vector<synth::Plane> planes);

}  // namespace belvedere
