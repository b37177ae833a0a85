#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/base/land_cover_class.h"
#include "renderer/base/progress.h"
#include "terrain/raster.h"
#include "terrain/raster_io.h"

namespace belvedere {

// What the codes of a land-cover raster mean.
struct Legend {
  std::string name;
  struct Entry {
    std::string label;  // the legend's own words
    LandCoverClass painted_as;
  };
  std::map<std::int32_t, Entry> entries;
};

// Built in: "esa_worldcover", "corine", "nlcd", "fbfm40" (data/legends/*.toml); else a .toml or .csv file. CSV: a header line with a
// code column (code, value, grid_value, …) and a class column holding class names; see docs. Error(usage) with file:line.
Legend read_legend(const std::string& name_or_path);

// Painted classes on their own grid, and the smooth borders between them.
struct LandCover {
  Raster<LandCoverClass> classes;  // sky where no land cover is known

  // The class at a place in the scene's CRS: membership of each class interpolated by cubic B-spline, then the largest (ties
  // to the lower id). Smooth borders, no stairs of the raster's cells.
  LandCoverClass at(double x, double y) const;
};

struct LandCoverParameters {
  std::vector<RasterSource> sources;
  std::string legend;                        // built-in name or file
  std::optional<LandCoverClass> unknown;     // class of codes that the legend lacks; none: they are an error (exit 3, codes and counts)
  std::optional<LandCoverClass> nodata;      // class where the raster has nothing; none: filled from the nearest known cell
};

// Reads and reprojects (nearest) into the frame's CRS and extent at the source's own resolution; codes to classes.
LandCover read_land_cover(const LandCoverParameters& parameters, const RasterFrame& frame, Progress& progress);

}  // namespace belvedere
