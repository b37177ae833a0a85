#pragma once

#include <string>
#include <vector>

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

}  // namespace belvedere::tools
