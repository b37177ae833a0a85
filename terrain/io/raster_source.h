#pragma once

#include <optional>
#include <string>

namespace belvedere {

// One raster file and its settings in a scene.
struct RasterSource {
  std::string path;
  int band = 1;               // from 1; of the raster `variable`
  std::string variable = {};  // name of the raster in a file of several; empty: the only one
  // How colours encode the heights (height_encoding.h); empty: the values are heights.
  std::string encoding = {};
  std::string
      crs;  // overrides or supplies the file's CRS ("EPSG:26911" or WKT); empty: the file's own
  double unit_to_m = 0.0;        // metres per unit of the values; 0: by the band's unit (feet are
                                 // recognized), metres if it has none
  std::optional<double> nodata;  // overrides the file's
  // Altitudes beyond these are void: for files with plausible-looking wrong values.
  std::optional<double> lowest_m, highest_m;
  // Cells that are higher or lower than all eight around them by more than this are void; 0: kept.
  double max_spike_m = 0.0;
};

}  // namespace belvedere
