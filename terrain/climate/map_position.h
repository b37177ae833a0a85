#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "terrain/io/raster.h"

namespace belvedere {

// A value that is linear over a map; positions in cells, centres at whole numbers.
struct MapPlane {
  double at_first = 0.0;  // at the centre of the top-left cell
  double per_column = 0.0;
  double per_row = 0.0;
  double at(double column, double row) const {
    return at_first + column * per_column + row * per_row;
  }
};

// Where on Earth a map lies, as far as sun and climate need it.
struct MapPosition {
  int width = 0;
  int height = 0;
  glm::dvec2 cell_m{1.0, 1.0};  // width and height of a cell on the ground
  MapPlane longitude_deg;       // undefined if the map has no CRS
  MapPlane latitude_deg;        // -90…90
  MapPlane grid_north_deg;  // true azimuth of the map's columns, clockwise; add it to an azimuth of
                            // the map to get the true azimuth

  glm::dvec2 centre_lonlat_deg() const {
    return {longitude_deg.at(0.5 * (width - 1), 0.5 * (height - 1)),
            latitude_deg.at(0.5 * (width - 1), 0.5 * (height - 1))};
  }
};

// Positions by the CRS. Without one the whole map lies at `latitude_deg` and its columns run north;
// Error(usage) if that is not given either. Values are rounded to 1e-7 degrees, so that the last
// bits of a projection do not affect a picture.
MapPosition make_map_position(const GeoTransform& transform, const std::string& crs, int width,
                              int height, std::optional<double> latitude_deg);

constexpr double earth_radius_km = 6371.0;
// A position on the globe, km from its centre: along the equator at 0° and 90° east, and to the
// north.
std::array<double, 3> earth_position_km(double longitude_deg, double latitude_deg);
// Squared distance of two such positions, through the Earth.
double squared_chord_km2(const std::array<double, 3>& a, const std::array<double, 3>& b);

}  // namespace belvedere
