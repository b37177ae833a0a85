#pragma once

#include <string>
#include <vector>

#include "base/progress.h"

namespace belvedere::tools {

// A rendered picture of the page: the folder that `belvedere render` wrote, and what it is called where there are several (a season).
struct WebPicture {
  std::string folder;
  std::string name;
};

struct WebParameters {
  int tile_px = 512;
  int quality = 88;           // of JPEG, 1…100
  int ground_cells = 400000;  // of what pointing tells; 9 bytes each
};

// Writes FOLDER/index.html, panorama.js and tiles/: a page that works from a file, without a server. The first picture's guidance.exr tells
// what is pointed at, its labels.geojson has the names, its notes the title and the sources; where guidance or labels are missing, so is
// what they tell. Further pictures are of the same view and size: Error(usage) else. Error(input) for a folder without a picture.
void write_web_page(const std::vector<WebPicture>& pictures, const std::string& folder, const WebParameters& parameters,
                    Progress& progress);

}  // namespace belvedere::tools
