#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "terrain/fetch/map_source.h"
#include "terrain/fetch/remote_file.h"
#include "terrain/fetch/tile_plan.h"
#include "terrain/io/raster.h"

namespace belvedere {

// A tile that was requested.
struct FetchedTile {
  MapTile tile;      // columns continue beyond the date line
  std::string name;  // "N46E011"
  std::string address;
  RemoteDescription about;
  std::string hash;  // of the cells that were read; empty if there are none
};

// The cells of an area on the service's own lattice. One raster, or if the lattice changes with
// latitude one for each cell size, from north to south. Voids: NaN; code 0.
template <class T>
struct TileMosaic {
  std::vector<Raster<T>> parts;
  std::vector<double>
      south;  // latitudes between parts; heights continue beyond them, for resampling
  std::vector<FetchedTile> tiles;
};

// Heights, m. A missing tile is sea only if the ground around it is at sea level; else the service
// withholds it, and Error(input) names it. shared_rows: number of rows of its neighbour that each
// part also has, if there are several.
TileMosaic<float> read_elevation_tiles(const MapSource& source, const DegreeBox& box,
                                       const std::string& mirror, const FetchContext& context,
                                       int shared_rows = 4);
// Codes 1…255, 0 where unknown and where tiles are missing. One of `step` × `step` cells is used.
TileMosaic<std::uint8_t> read_cover_tiles(const MapSource& source, const DegreeBox& box, int step,
                                          const std::string& mirror, const FetchContext& context);

}  // namespace belvedere
