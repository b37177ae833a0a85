#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "terrain/fetch/http_client.h"
#include "terrain/fetch/map_source.h"
#include "terrain/fetch/tile_mosaic.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// What is to be fetched: a rectangle around a place, upright in the UTM zone of that place.
struct FetchParameters {
  glm::dvec2 at_lonlat{0.0, 0.0};              // the middle: longitude -180…180, latitude -90…90
  glm::dvec2 size_km{60.0, 60.0};              // west to east, south to north; each 1…400
  std::string elevation = "copernicus_glo30";  // a built-in source or a .toml file
  std::string land_cover = "esa_worldcover";   // the same; empty: none
  double cell_m = 0.0;                         // of the elevation, m; 0: as the source says; 1…10000
  double cover_cell_m = 0.0;                   // of the land cover; 0: as the source says, wider where there were over 64 million cells
  std::string mirror;                          // takes the place of the sources' servers; empty: none
  bool refresh = false;                        // asks servers anew what their files are; else what is known holds for 30 days
  std::int64_t now_unix_s = 0;                 // what time it is; 0: by the machine's clock
  HttpManners manners;
};

// One map that was fetched, and what a scene is to say of it: keys of [[terrain.sources]] and [[land_cover.sources]].
struct FetchedMap {
  std::string file;      // its name in the folder
  std::string origin;    // source, release, tiles, day
  std::string licence;   // credit first
  std::string get_from;  // the command that gets it again, and the service
  MapSource source;
  RasterFrame frame;
  std::vector<FetchedTile> tiles;
  std::string hash;  // of the file, as lock files have it
};

struct FetchedArea {
  FetchedMap elevation;
  std::optional<FetchedMap> land_cover;  // its legend: source.legend
  std::string record;                    // path of fetched.toml
  std::uint64_t questions = 0;           // that servers were asked
  std::uint64_t bytes = 0;               // that came
};

}  // namespace belvedere
