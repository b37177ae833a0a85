#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <string>

#include "base/grid.h"
#include "tools/web/tile_pyramid.h"

namespace belvedere::tools {

// A picture of encoded RGB as a pyramid of tiles in memory, to be served: JPEG by their names
// "LEVEL/COLUMN_ROW.jpg".
struct PictureTiles {
  TilePyramid pyramid;
  std::map<std::string, std::string> files;
};
PictureTiles picture_tiles(const Grid<glm::vec3>& picture, const TileParameters& parameters = {});

}  // namespace belvedere::tools
