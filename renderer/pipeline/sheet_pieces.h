#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/pixel_rect.h"
#include "renderer/scene/scene_file.h"
#include "renderer/sheet/guidance_choice.h"
#include "renderer/sheet/work_folder.h"

namespace belvedere {

// What is asked of a sheet.
struct SheetRequest {
  bool panorama = true;                  // else guidance alone
  GuidanceChoice channels = {};          // that guidance.exr holds; none at all: there is no such file
  std::vector<std::string> layers = {};  // also panorama.ENDING of these formats (renderer/image/layers/layer_file.h)
  bool matches = false;                  // also match.exr: which texel each pixel was copied from
  std::optional<PixelRect> part = {};    // of the sheet, px; absent: all of it
  bool resume = false;                   // go on from the pieces of a run that ended
  int piece_px = 0;                      // side of a piece, 64…4096; 0: 1024. Changes no pixel
  int block_px = 0;                      // side of what is made and painted at once, 64…4096; 0: what memory allows. Changes no pixel
};

// The pixels asked for. Error(usage) for a part that does not lie on the sheet.
PixelRect region_of(const Scene& scene, const SheetRequest& request);
// Products whose pieces are made.
std::vector<std::string> products_of(const SheetRequest& request);
// The squares of the sheet's fixed grid that the region touches, cut to it, in the order in which they are made: along the shorter side,
// so that what must be kept of the stages before is least.
std::vector<PixelRect> pieces_of(PixelRect region, const SheetRequest& request);
// The most that layers of a piece take while it is painted, bytes.
double piece_bytes_of(const Scene& scene, const SheetRequest& request);
// The least that a piece can be painted in, px: one that is cut into layers is painted as a whole.
int least_block_px_of(const SheetRequest& request);
// Which of `count` pieces a part of a plan makes: the numbers [first, end). Parts count from 1.
struct PieceSpan {
  std::size_t first = 0;
  std::size_t end = 0;
};
PieceSpan pieces_of_part(std::size_t count, int part, int parts);
// All that the pixels of a request hang on.
JobIdentity identify(const LoadedScene& loaded, const SheetRequest& request);

}  // namespace belvedere
