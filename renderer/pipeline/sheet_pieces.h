#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/pixel_rect.h"
#include "renderer/paint/composite.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/scene/scene_file.h"
#include "renderer/sheet/piece_file.h"
#include "renderer/sheet/work_folder.h"
#include "renderer/world/world.h"

namespace belvedere {

// A request for a sheet.
struct SheetRequest {
  bool panorama = true;          // else guidance alone
  GuidanceChoice channels = {};  // that guidance.exr holds; none: no file
  std::vector<std::string> layers =
      {};                // also panorama.EXT in these formats (renderer/image/layers/layer_file.h)
  bool matches = false;  // also match.exr: which texel each pixel was copied from
  std::optional<PixelRect> part = {};  // of the sheet, px; absent: all of it
  bool replace = false;                // overwrite files of others in the folder of results
  bool resume = false;                 // continue from the pieces of an earlier run
  int piece_px = 0;                    // side of a piece, 64…4096; 0: 1024. Changes no pixel
  int block_px = 0;  // side of the squares that are computed and painted at once, 64…4096; 0: by
                     // memory. Changes no pixel
};

// The requested pixels. Error(usage) for a part outside the sheet.
PixelRect region_of(const Scene& scene, const SheetRequest& request);
// The products of a request that are made in pieces.
std::vector<std::string> products_of(const SheetRequest& request);
// Divides a region into pieces: the squares of the sheet's fixed grid that it touches, clipped to
// it, in the order in which they are made: along the shorter side, so that the least has to be kept
// of the previous stages.
std::vector<PixelRect> pieces_of(PixelRect region, const SheetRequest& request);
// Maximum memory of the layers of a piece while it is painted, bytes.
double piece_bytes_of(const Scene& scene, const SheetRequest& request);
// Minimum side of a painted block, px: a piece that is cut into layers is painted as a whole.
int min_block_px_of(const SheetRequest& request);
// The pieces of one part of a plan: the numbers [first, end) of `count`. Parts count from 1.
struct PieceSpan {
  std::size_t first = 0;
  std::size_t end = 0;
};
PieceSpan pieces_of_part(std::size_t count, int part, int parts);
// Identifies a job by everything that the pixels of a request depend on.
JobIdentity identify(const LoadedScene& loaded, const SheetRequest& request);

// Memory of making a sheet: what stays as long as pieces are made, tiles that stages keep for their
// neighbours, and the window of the stage at work, which gets the rest. Block and tile sizes that
// follow from it do not change the result.

// Bytes, as far as they are known; a piece that is written while the next is painted is small in
// comparison.
struct StandingBytes {
  double ground =
      0.0;  // terrain and its ray-tracing structure; fitted to memory when it is read (scene_dem.h)
  double besides = 0.0;  // pictures to copy from with their comparison data, layers of a piece
};
double ground_bytes(const World& world);
// The same before it is made, of so many cells (held_ground_cells).
double ground_bytes(double cells);
double copying_bytes(const std::vector<PaintedExemplar>& exemplars);
// The same before an example sheet is painted, for all paintings together.
double copying_bytes(const Scene& scene, double painting_texels);

inline constexpr int largest_block_px = 1024;
inline constexpr int min_block_px = 128;

// Memory limit of the tiles of all stages together, bytes; further ones are in scratch files.
std::uint64_t kept_tile_bytes();

// Side of the largest square of the sheet that memory allows to paint at once, px: the larger it
// is, the less is computed twice at margins. Error(limit) where even `min_px` does not fit.
int choose_block_px(const Scene& scene, double pixels_per_unit, const StandingBytes& standing = {},
                    int min_px = min_block_px, const Style* style = nullptr);
// Side of the tiles of the stages of a sheet, px; no larger than a block. `region`: the part of the
// sheet that is made.
int choose_tile_px(int block_px, PixelRect region);

}  // namespace belvedere
