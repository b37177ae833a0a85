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

// Meaning of the codes of a land-cover raster.
struct Legend {
  std::string name;
  struct Entry {
    std::string label;  // the source's own name of the code
    LandCoverClass painted_as;
  };
  std::map<std::int32_t, Entry> entries;
  std::set<std::int32_t> nodata;  // codes for unknown cells
};

// Built in: "esa_worldcover", "corine", "nlcd", "fbfm40" (data/legends/*.toml); else a .toml or
// .csv file (docs/legends.md). A .toml may name a CSV file, in its own folder or one of `folders`.
// Error(usage) with file:line:column if the legend is malformed, Error(input) if a file is missing.
Legend read_legend(const std::string& name_or_path, const std::vector<std::string>& folders = {});

// Colour of the ground in an orthophoto: encoded sRGB, and 255 if it is known, else 0.
using GroundColour = glm::vec<4, std::uint8_t>;

// Relief that surface layers add to the ground, on the cells of the DEM: bumps below the resolution
// of the DEM, and lake beds.
struct GroundRelief {
  struct Bumps {
    double height_m = 0.0;   // amplitude at full cover
    double length_m = 8.0;   // size of the largest bumps
    std::uint64_t seed = 0;  // of their noise
    Grid<float> share;       // cover, 0…1
  };
  GeoTransform transform;
  std::vector<Bumps> bumps;
  Grid<float> lake_depth_m;  // of the water, 0 on land; empty: beds are not visible

  // The depth at a position in the scene's CRS, m.
  float depth_at(double x, double y) const;
};

// Painted classes on their own grid, and the smooth borders between them.
struct LandCover {
  Raster<LandCoverClass> classes;     // sky where unknown; never empty
  Raster<GroundColour> colours = {};  // on cells of their own; empty if not requested
  GroundRelief relief = {};           // the same
  // Areas and rivers of a map that lie over the classes, with their own outlines, and below them
  // inferred rivers; null: none. `classes` includes them in its cells.
  std::shared_ptr<const MapCover> map = {};
  std::shared_ptr<const MapCover> inferred = {};
  Grid<LandCoverClass> below = {};  // the cells without either map; empty where neither exists
  std::vector<CoverRiver> inferred_rivers =
      {};  // lines that rules made, before they are laid over the classes

  // The class at a position in the scene's CRS: the membership of each class interpolated by cubic
  // B-spline, then the largest (ties to the lower id). Borders are smooth instead of following the
  // raster's cells; lines one cell wide become a little narrower, single cells vanish. Beyond the
  // raster the nearest cells are used. A map at the position takes precedence.
  LandCoverClass at(double x, double y) const;
  // The class of the cells alone, without the map.
  LandCoverClass cell_at(double x, double y) const;
  // The class of the map alone, inferred rivers included; sky where there is nothing.
  LandCoverClass laid_at(glm::dvec2 position) const;
};

// Lays a map over the classes. Inferred water that touches a lake of the map becomes the
// surrounding class, because the map has the true shore. `own`, if given, supplies the cells: the
// same map before its rivers were widened for a picture.
void lay_map(LandCover& cover, std::shared_ptr<const MapCover> map, const MapCover* own = nullptr);
// Lays inferred rivers below the map, likewise. Rivers that are laid already are replaced by the
// same ones as another picture shows them: the cells stay.
void lay_inferred(LandCover& cover, std::shared_ptr<const MapCover> inferred,
                  const MapCover* own = nullptr);

struct LandCoverParameters {
  std::vector<RasterSource> sources;
  std::string legend;  // built-in name or file
  std::vector<std::string>
      folders;  // searched for a CSV file that the legend names, after the legend's own folder
  std::optional<LandCoverClass>
      unknown;  // class of codes missing from the legend; none: Error(input) with codes and counts
  double finest_cell_m = 0.0;  // limit of the resolution that is read; 0: none
  std::optional<LandCoverClass>
      nodata;  // class of unknown cells; none: filled from the nearest known cell
};

// Reads and reprojects (nearest neighbour) into the frame's CRS and extent at the source's own
// resolution and maps codes to classes.
LandCover read_land_cover(const LandCoverParameters& parameters, const RasterFrame& frame,
                          Progress& progress);

// An orthophoto (red, green and blue, 8 bits, encoded sRGB) on the cells of a frame: averaged where
// it is finer, smoothly interpolated where it is coarser, unknown where it has no data.
// Error(input) if it has fewer than three bands or values beyond 255, and if it does not cover any
// of a frame that it must_overlap.
Raster<GroundColour> read_ground_image(const std::string& path, const RasterFrame& frame,
                                       bool must_overlap, Progress& progress);

}  // namespace belvedere
