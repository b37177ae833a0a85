#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "terrain/fetch/map_source.h"
#include "terrain/fetch/remote_file.h"
#include "terrain/io/raster.h"

namespace belvedere {

// The requested area, in degrees of the service's CRS.
struct DegreeBox {
  double west = 0.0, south = 0.0, east = 0.0,
         north = 0.0;  // east exceeds 180 if the area crosses the date line
};

// Cells of one size, shared by rows of tiles: the lattice of a part. Cells are counted from the
// source's origin; with a step, only every step-th is used.
struct TileLattice {
  const MapSource& source;
  int columns = 0;  // of a tile
  int step = 1;

  double width_deg() const { return source.tile_deg.x / columns; }
  double height_deg() const { return source.tile_deg.y / source.rows; }
  double shift() const { return source.on_lines ? 0.5 : 0.0; }
  // Sides of cells are whole numbers.
  double column_at(double longitude) const {
    return (longitude - source.origin_deg.x) / width_deg() + shift();
  }
  double row_at(double latitude) const {
    return (source.origin_deg.y - latitude) / height_deg() + shift();
  }
  GeoTransform transform(int x0, int y0) const {
    return {source.origin_deg.x + (static_cast<double>(x0) * step - shift()) * width_deg(),
            source.origin_deg.y - (static_cast<double>(y0) * step - shift()) * height_deg(),
            step * width_deg(), step * height_deg()};
  }
  // The source cell of one of the used cells.
  int source_cell(int ours) const { return ours * step + step / 2; }
  // The first used cell at or after a cell of the source.
  int first_from(int cell) const {
    return static_cast<int>(std::ceil(static_cast<double>(cell - step / 2) / step));
  }
};

// Rows of tiles with cells of one size, and the used cells needed there.
struct PartPlan {
  TileLattice lattice;
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // half open
};

// The parts of a box, from north to south, with some cells around it for resampling. One of `step`
// × `step` cells is used.
std::vector<PartPlan> plan_parts(const MapSource& source, const DegreeBox& box, int step);

// The cells of a part that lie in one tile: half open, in used cells.
struct TileCells {
  MapTile tile;
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// Tiles of a part that may exist, row by row.
std::vector<TileCells> tiles_of_part(const PartPlan& part);

// The tile that contains a used cell.
MapTile tile_at(const PartPlan& plan, int x, int y);

// Tiles that contain a part of the box and may exist, row by row.
std::vector<MapTile> tiles_of(const MapSource& source, const DegreeBox& box);

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
