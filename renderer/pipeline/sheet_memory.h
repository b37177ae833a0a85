#pragma once

#include <cstdint>
#include <vector>

#include "base/pixel_rect.h"
#include "renderer/paint/composite.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/world.h"

namespace belvedere {

// Memory of making a sheet: what stays as long as pieces are made, tiles that stages keep for their
// neighbours, and the window of the stage at work, which gets the rest. None of it changes a pixel.

// Bytes, as far as they are known; a piece that is written while the next is painted is small in
// comparison.
struct StandingBytes {
  double ground =
      0.0;  // terrain and its ray-tracing structure; fitted to memory when it is read (scene_dem.h)
  double besides = 0.0;  // pictures to copy from with their comparison data, layers of a piece
};
double ground_bytes(const World& world);
double copying_bytes(const std::vector<PaintedExemplar>& exemplars);
// The same before an example sheet is painted; of all paintings together.
double copying_bytes(const Scene& scene, double painting_texels);

inline constexpr int largest_block_px = 1024;
inline constexpr int min_block_px = 128;

// Limit of the tiles of all stages together; further ones are in scratch files.
std::uint64_t kept_tile_bytes();

// Side of the largest square of the sheet that memory allows to paint at once, px: the larger, the
// less is computed twice at margins. Error(limit) where even `min_px` does not fit.
int choose_block_px(const Scene& scene, double pixels_per_unit, const StandingBytes& standing = {},
                    int min_px = min_block_px, const Style* style = nullptr);
// Side of the tiles of the stages of a sheet, px: no larger than a block. region: the part of the
// sheet that is made.
int choose_tile_px(int block_px, PixelRect region);

}  // namespace belvedere
