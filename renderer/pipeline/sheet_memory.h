#pragma once

#include <cstdint>
#include <vector>

#include "base/pixel_rect.h"
#include "renderer/paint/composite.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/world.h"

namespace belvedere {

// What the making of a sheet takes of the memory that a run may use: what stands there as long as pieces are made, tiles that stages keep
// for their neighbours, and the window of the stage at work, which gets what is left. Nothing of it changes a pixel.

// Bytes, as far as they are known; a piece that is written while the next is painted is small beside them.
struct StandingBytes {
  double ground = 0.0;   // terrain and what rays find it by; fitted to memory when it is read (scene_dem.h)
  double besides = 0.0;  // pictures to copy from with what they are compared by, layers of a piece
};
double ground_bytes(const World& world);
double copying_bytes(const std::vector<PaintedExemplar>& exemplars);
// The same before an example sheet is painted; `paintings` as they were read, none: they are not yet.
double copying_bytes(const Scene& scene, const std::vector<ScannedPainting>& paintings);

inline constexpr int largest_block_px = 1024;
inline constexpr int least_block_px = 128;

// What tiles of all stages may take together; further ones lie in scratch files.
std::uint64_t kept_tile_bytes();

// Side of the largest square of the sheet that memory lets be painted at once, and be made of a stage, px: the larger, the less is made
// twice at their margins. Error(limit) where not even one of `least_px` does.
int choose_block_px(const Scene& scene, double pixels_per_unit, const StandingBytes& standing = {}, int least_px = least_block_px);
// Side of the tiles that the stages of a sheet are made in, px: no larger than a block. region: the part of the sheet that is made.
int choose_tile_px(int block_px, PixelRect region);

}  // namespace belvedere
