#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <string>

#include "base/grid.h"
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

// Takes a tile, of encoded RGB; called from several threads.
using TakeTile =
    std::function<void(int level, int column, int row, const Grid<glm::vec3>& encoded)>;
// Hands over the rows of a picture in strips from top to bottom, of encoded RGB.
using TakeRows = std::function<void(const Grid<glm::vec3>& encoded)>;
using ReadRows = std::function<void(const TakeRows& take)>;

// Cuts a picture of that size into tiles. Memory holds a row of tiles of each level; smaller levels
// are means in linear light.
TilePyramid cut_into_tiles(int width, int height, int tile_px, const ReadRows& read,
                           const TakeTile& take);

// Writes FOLDER/LEVEL/COLUMN_ROW.jpg, reading the picture once from top to bottom. The folder must
// exist. Error(input) for a picture that cannot be read, Error(output).
TilePyramid write_tile_pyramid(const std::string& picture, const std::string& folder,
                               const TileParameters& parameters, Progress& progress);

}  // namespace belvedere::tools
