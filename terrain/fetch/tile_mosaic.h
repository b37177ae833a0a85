#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "terrain/fetch/map_source.h"
#include "terrain/fetch/remote_file.h"
#include "terrain/fetch/tile_plan.h"
#include "terrain/io/raster.h"

namespace belvedere {

// A tile that was looked at.
struct FetchedTile {
  MapTile tile;      // columns go on beyond the date line
  std::string name;  // "N46E011"
  std::string address;
  RemoteDescription about;
  std::string hash;  // of the cells that were read; empty where there are none
};

// The cells of an area on the service's own lattice. One raster, or where the lattice changes with latitude one for each kind of cells,
// from north to south. Voids: NaN; code 0.
template <class T>
struct TileMosaic {
  std::vector<Raster<T>> parts;
  std::vector<double> south;  // latitudes where parts end and the next begin; heights go on beyond, for whoever resamples
  std::vector<FetchedTile> tiles;
};

// Heights, m. A tile that is not there is sea only where the ground around it says so: else it is ground that the service keeps back, an
// Error(input) that names it.
// shared_rows: of its neighbour that each part has as well, where there are several.
TileMosaic<float> read_elevation_tiles(const MapSource& source, const DegreeBox& box, const std::string& mirror, const RemoteErrand& errand,
                                       int shared_rows = 4);
// Codes 1…255, 0 where nothing is known and where tiles are missing. Of `step` × `step` cells one is taken.
TileMosaic<std::uint8_t> read_cover_tiles(const MapSource& source, const DegreeBox& box, int step, const std::string& mirror,
                                          const RemoteErrand& errand);

}  // namespace belvedere
