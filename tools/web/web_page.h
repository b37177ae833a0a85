#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"

namespace belvedere::tools {

// A rendered picture of the page: the folder that `belvedere render` wrote, and its name where
// there are several (a season).
struct WebPicture {
  std::string folder;
  std::string name;
};

struct WebParameters {
  int tile_px = 512;
  int quality = 88;           // of JPEG, 1…100
  int ground_cells = 400000;  // of positions; 9 bytes each
  bool replace = false;       // also files in the folder that others wrote
};

// Writes FOLDER/index.html, panorama.js and tiles/: a page that works from a file, without a
// server. The first picture's guidance.exr gives the positions under the pointer, its
// labels.geojson the names, its notes the title and the sources; what is missing is left out.
// Further pictures must be of the same view and size, otherwise Error(usage). Error(input) for a
// folder without a picture.
void write_web_page(const std::vector<WebPicture>& pictures, const std::string& folder,
                    const WebParameters& parameters, Progress& progress);

// The ground under the pixels of a picture, every step-th of them, for pages: at the centres of
// squares of `step_px`.
struct ReadOut {
  int step_px = 1;
  Grid<float> distance_m;  // infinite for sky
  Grid<float> altitude_m;
  Grid<float> class_id;
  Grid<double> longitude_deg;  // WGS 84, position on the map, before bend and handles
  Grid<double> latitude_deg;
  bool has_places = false;  // the terrain has a coordinate system
};

// Samples a guidance file, at most about `max_cells` of it, whatever its size. Error(input) for a
// file without distances or classes.
ReadOut sample_read_out(const std::string& guidance_file, int max_cells);

// The samples as a JavaScript object: planes of whole numbers in base64, low byte first. class: 8
// bits, 255 for sky; altitude: 16 bits, m + 1000; distance: 16 bits, 10 m; longitude and latitude:
// 16 bits, in 1/65535 of the extent.
std::string read_out_script(const ReadOut& read_out);

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
