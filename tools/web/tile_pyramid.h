#pragma once

#include <string>

#include "base/progress.h"

namespace belvedere::tools {

struct TileParameters {
  int tile_px = 512;  // side of a tile, 64…4096
  int quality = 88;   // of JPEG, 1…100
};

// A picture in tiles of several levels, so that pages load only what is visible.
struct TilePyramid {
  int width = 0;  // of level 0, the picture itself
  int height = 0;
  int tile_px = 0;
  int levels = 0;  // each has half the pixels per side of the previous one; the last is one tile
};

// Writes FOLDER/LEVEL/COLUMN_ROW.jpg, reading the picture once from top to bottom: memory holds a
// row of tiles of each level. Smaller levels are means in linear light. The folder must exist.
// Error(input) for a picture that cannot be read, Error(output).
TilePyramid write_tile_pyramid(const std::string& picture, const std::string& folder,
                               const TileParameters& parameters, Progress& progress);

}  // namespace belvedere::tools
