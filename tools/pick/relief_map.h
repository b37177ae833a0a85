#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <string>

#include "base/grid.h"
#include "terrain/io/dem.h"
#include "tools/web/tile_pyramid.h"

namespace belvedere::tools {

// A DEM as a relief map for finding places, north up: shaded from two sides and tinted by altitude,
// green in the valleys, pale above; grey without data. A pixel a cell, or the mean of as many as
// bring its longer side to longest_px. Encoded RGB.
struct ReliefMap {
  Grid<glm::vec3> picture;
  int cells_per_px = 1;  // along a side; at the right and lower border fewer
};
ReliefMap relief_map(const Dem& dem, int longest_px = 4096);

// A picture of encoded RGB as a pyramid of tiles in memory, to be served: JPEG by their names
// "LEVEL/COLUMN_ROW.jpg".
struct PictureTiles {
  TilePyramid pyramid;
  std::map<std::string, std::string> files;
};
PictureTiles picture_tiles(const Grid<glm::vec3>& picture, const TileParameters& parameters = {});

}  // namespace belvedere::tools
