#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace belvedere {

// A service of map tiles in a geographic lattice, described by a file of data/sources or a user's
// own (docs/fetch.md).

enum class MapSourceKind { elevation, land_cover };
// Meaning of a tile that the service does not have.
enum class MissingTile { sea, nothing, error };

struct MapSource {
  std::string id;    // "copernicus_glo30": its built-in name, or its file's without the extension
  std::string name;  // for messages
  MapSourceKind kind = MapSourceKind::elevation;
  std::string url;       // of a tile; with {lat} and {lon}, or {row} and {column}
  std::string date;      // date of the data, and their release
  std::string legend;    // of land cover: value for a scene's land_cover.legend
  double cell_m = 30.0;  // of the map produced, m; 0.1…10000
  MissingTile missing = MissingTile::error;
  double sea_value = 0.0;  // of cells in the sea: m, or a code
  std::string get_from, credit, licence;

  // The tiles: a lattice in degrees of `crs`, which is geographic.
  std::string crs = "EPSG:4326";
  glm::dvec2 tile_deg{1.0, 1.0};                    // longitude, latitude; both divide the circle
  glm::dvec2 origin_deg{-180.0, 90.0};              // the north-west corner of a tile
  std::array<double, 2> latitudes = {-90.0, 90.0};  // there are no tiles beyond them
  int rows = 0;                                     // cells of a tile from north to south
  struct Columns {
    double from_latitude;  // |°|, of the side of a tile that is nearer to the equator
    int count;             // cells from west to east
  };
  std::vector<Columns> columns;
  bool on_lines = false;  // centres of a tile's first cells lie on its north and west sides; else
                          // half a cell within
};

// A built-in name or a .toml file. Error(usage) with the position and what is allowed there;
// Error(input) if the file is missing.
MapSource read_map_source(const std::string& name_or_path);
// The same from text.
MapSource parse_map_source(const std::string& text, const std::string& name);
std::vector<std::string> built_in_map_sources();

// A tile by its number on the lattice: columns to the east of the origin, rows to the south.
// Columns wrap around the earth.
struct MapTile {
  int column = 0, row = 0;
  bool operator==(const MapTile&) const = default;
  auto operator<=>(const MapTile&) const = default;
};

// Longitude and latitude of a tile's south-west corner; longitude in -180…180.
glm::dvec2 tile_corner(const MapSource& source, MapTile tile);
// Whether the service may have it.
bool in_latitudes(const MapSource& source, MapTile tile);
// Cells of the tiles in a row from west to east.
int tile_columns(const MapSource& source, int row);
// "N46E011"
std::string tile_name(const MapSource& source, MapTile tile);
// Position of the tile. mirror: replaces the server in the address, "http://localhost:8000/maps";
// empty: the source's own.
std::string tile_address(const MapSource& source, MapTile tile, const std::string& mirror);

}  // namespace belvedere
