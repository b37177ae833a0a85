#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/cache/cache.h"
#include "base/progress.h"
#include "terrain/fetch/map_source.h"
#include "terrain/fetch/remote_file.h"
#include "terrain/fetch/tile_mosaic.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// Request: a rectangle around a position, upright in the UTM zone of that position.
struct FetchParameters {
  glm::dvec2 at_lonlat{0.0, 0.0};  // the centre: longitude -180…180, latitude -90…90
  glm::dvec2 size_km{60.0, 60.0};  // west to east, south to north; each 1…400
  std::string elevation = "copernicus_glo30";  // a built-in source or a .toml file
  std::string land_cover = "esa_worldcover";   // the same; empty: none
  double cell_m = 0.0;  // of the elevation, m; 0: as in the source; 1…10000
  double cover_cell_m =
      0.0;             // of the land cover; 0: as in the source, larger above 64 million cells
  std::string mirror;  // replaces the sources' servers; empty: none
  bool refresh =
      false;  // asks servers again for file properties; else known ones are valid for 30 days
  bool replace = false;         // also files in the folder that others wrote
  std::int64_t now_unix_s = 0;  // current time; 0: by the machine's clock
  HttpOptions http_options;
};

// One downloaded map and its entry for a scene: keys of [[terrain.sources]] and
// [[land_cover.sources]].
struct FetchedMap {
  std::string file;      // its name in the folder
  std::string origin;    // source, release, tiles, day
  std::string licence;   // starts with the credit
  std::string get_from;  // the command to download it again, and the service
  MapSource source;
  RasterFrame frame;
  std::vector<FetchedTile> tiles;
  std::string hash;  // of the file, as in lock files
};

struct FetchedArea {
  FetchedMap elevation;
  std::optional<FetchedMap> land_cover;  // its legend: source.legend
  std::string record;                    // path of fetched.toml
  std::uint64_t questions = 0;           // requests sent to servers
  std::uint64_t bytes = 0;               // received
};

// Text at the start of a record, for direct use by its reader.
using RecordHead = std::function<std::string(const FetchedArea&)>;
// TOML with the provenance of every map and tile, after the head.
std::string fetch_record(const FetchParameters& parameters, const FetchedArea& area,
                         const RecordHead& head = {});
// Writes it atomically. Error(output).
void write_fetch_record(const std::string& path, const FetchParameters& parameters,
                        const FetchedArea& area, const RecordHead& head = {});

// The frame of a request at a cell size: centre and size rounded outwards to whole cells of the
// zone's lattice. Error(usage) for values out of range, and if a pole lies inside.
RasterFrame fetch_frame(const FetchParameters& parameters, double cell_m);
// Degrees that contain a frame.
DegreeBox degrees_around(const RasterFrame& frame, const std::string& crs);

// Downloads the maps of an area and writes them into a folder, which is created if it is missing:
// elevation.tif (m, voids -9999), land_cover.tif (codes, 0 where unknown) and fetched.toml with
// their provenance. Files are written atomically, the record last, with `head` at its start.
// Downloads are cached, so a call after a failed one continues. Accesses the network without
// asking. Error(input) if servers fail, Error(output) if the folder cannot be written.
FetchedArea fetch_area(const FetchParameters& parameters, const std::string& folder,
                       const Cache& cache, Progress& progress, const RecordHead& head = {});

}  // namespace belvedere
