#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/land_cover_class.h"
#include "base/progress.h"
#include "terrain/cover/map_cover.h"
#include "terrain/io/raster.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// What the codes of a land-cover raster mean.
struct Legend {
  std::string name;
  struct Entry {
    std::string label;  // the legend's own words
    LandCoverClass painted_as;
  };
  std::map<std::int32_t, Entry> entries;
  std::set<std::int32_t> nodata;  // codes that say that nothing is known
};

// Built in: "esa_worldcover", "corine", "nlcd", "fbfm40" (data/legends/*.toml); else a .toml or .csv file (docs/legends.md). A .toml
// may name a CSV file, which lies beside it or in one of `folders`. Error(usage) with file:line:column where the legend
// is wrong, Error(input) where a file is missing.
Legend read_legend(const std::string& name_or_path, const std::vector<std::string>& folders = {});

// What colour the ground has, as a picture from above shows it: encoded sRGB, and how much of it is known, 0 or 255.
using GroundColour = glm::vec<4, std::uint8_t>;

// What surface layers add to the form of the ground, on the cells of the DEM: bumps that no DEM holds, and the beds of lakes.
struct GroundRelief {
  struct Bumps {
    double height_m = 0.0;   // up and down, where they cover all
    double length_m = 8.0;   // of the largest
    std::uint64_t seed = 0;  // of their noise
    Grid<float> share;       // how much they cover, 0…1
  };
  GeoTransform transform;
  std::vector<Bumps> bumps;
  Grid<float> lake_depth_m;  // of the water, 0 on land; empty: beds are not seen

  // The depth at a place in the scene's CRS, m.
  float depth_at(double x, double y) const;
};

// Painted classes on their own grid, and the smooth borders between them.
struct LandCover {
  Raster<LandCoverClass> classes;     // sky where no land cover is known; never empty
  Raster<GroundColour> colours = {};  // on cells of their own; empty where nobody asked for them
  GroundRelief relief = {};           // the same
  // Areas and rivers of a map that lie over the classes, with their own outlines, and below them rivers that are guessed; null: none.
  // `classes` has them in its cells …
  std::shared_ptr<const MapCover> map = {};
  std::shared_ptr<const MapCover> guessed = {};
  Grid<LandCoverClass> below = {};               // … and these are the cells without them; empty without both
  std::vector<CoverCourse> guessed_rivers = {};  // before they are laid: what rules made beside the classes

  // The class at a place in the scene's CRS: membership of each class interpolated by cubic B-spline, then the largest (ties
  // to the lower id). Smooth borders, no stairs of the raster's cells; what is one cell wide becomes a little narrower, single
  // cells vanish. Beyond the raster the nearest cells go on. What a map has at the place goes before.
  LandCoverClass at(double x, double y) const;
  // The same without what a map has there …
  LandCoverClass cell_at(double x, double y) const;
  // … and that alone, guessed rivers too; sky where there is nothing.
  LandCoverClass laid_at(glm::dvec2 place) const;
};

// Lays a map over the classes. Guessed water that touches a lake of the map becomes what lies around it: the map knows the shore. The cells
// are those of `own` where it is given: the same map before its rivers were widened for a picture.
void lay_map(LandCover& cover, std::shared_ptr<const MapCover> map, const MapCover* own = nullptr);
// Lays guessed rivers below the map, likewise.
void lay_guessed(LandCover& cover, std::shared_ptr<const MapCover> guessed, const MapCover* own = nullptr);

struct LandCoverParameters {
  std::vector<RasterSource> sources;
  std::string legend;                     // built-in name or file
  std::vector<std::string> folders;       // where a CSV file that the legend names is looked for, after the legend's own folder
  std::optional<LandCoverClass> unknown;  // class of codes that the legend lacks; none: they are an error (exit 3, codes and counts)
  double finest_cell_m = 0.0;             // nothing finer is read; 0: all that the sources have
  std::optional<LandCoverClass> nodata;   // class where the raster has nothing; none: filled from the nearest known cell
};

// Reads and reprojects (nearest) into the frame's CRS and extent at the source's own resolution; codes to classes.
LandCover read_land_cover(const LandCoverParameters& parameters, const RasterFrame& frame, Progress& progress);

}  // namespace belvedere
