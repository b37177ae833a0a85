#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "base/grid.h"

namespace belvedere {

// Position of cells in a metric or geographic CRS. North-up only: readers resample rotated rasters.
// (origin_x, origin_y) is the outer corner of the top-left cell; y decreases downwards.
struct GeoTransform {
  double origin_x = 0.0;
  double origin_y = 0.0;
  double cell_x = 1.0;  // > 0, width of a cell in CRS units
  double cell_y = 1.0;  // > 0, height of a cell in CRS units

  // CRS coordinates to fractional cells whose centres lie at whole numbers.
  glm::dvec2 to_cell(double x, double y) const {
    return {(x - origin_x) / cell_x - 0.5, (origin_y - y) / cell_y - 0.5};
  }
  // Fractional cells to CRS coordinates.
  glm::dvec2 to_crs(double column, double row) const {
    return {origin_x + (column + 0.5) * cell_x, origin_y - (row + 0.5) * cell_y};
  }
  bool operator==(const GeoTransform&) const = default;
};

// A grid with geography. Voids are NaN in a Raster<float>.
template <class T>
struct Raster {
  Grid<T> cells;
  GeoTransform transform;
  std::string crs;  // WKT2, empty if unknown
};

}  // namespace belvedere
