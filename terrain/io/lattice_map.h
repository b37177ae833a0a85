#pragma once

#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "terrain/io/raster.h"
#include "terrain/io/raster_file.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// Position of a frame's cells on the lattice of a source, with cell centres at whole numbers. The
// reprojection is exact at control points and bilinear in between. A map's curvature over n cells
// of c metres bends a line by about (n c)² / 8 R, up to four times that near the poles and at the
// edges of UTM zones, so n is chosen for an error below a thousandth of a cell.
class LatticeMap {
 public:
  // `source`: its cells and CRS; `middle`: the centre of its area, in its CRS; longitudes of a
  // geographic CRS are counted near it.
  LatticeMap(const CellAffine& source, const std::string& source_crs, glm::dvec2 centre,
             const RasterFrame& frame);

  // Sets the frame's cell from which cells are counted: for a window of the frame, whose values
  // must equal those of the whole.
  void begin_at(glm::ivec2 corner) { corner_ = corner; }

  // If every cell of the frame is a cell of the lattice: the lattice's cell under the first one
  // counted.
  std::optional<glm::ivec2> offset() const {
    return offset_ ? std::optional(*offset_ + corner_) : std::nullopt;
  }

  // Position of a cell of the frame.
  glm::dvec2 operator()(int x, int y) const {
    x += corner_.x;
    y += corner_.y;
    const int i = x / step_;
    const int j = y / step_;
    const double u = static_cast<double>(x - i * step_) / step_;
    const double v = static_cast<double>(y - j * step_) / step_;
    const glm::dvec2* p =
        points_.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(across_) + i;
    const glm::dvec2 at = (1.0 - v) * ((1.0 - u) * p[0] + u * p[1]) +
                          v * ((1.0 - u) * p[across_] + u * p[across_ + 1]);
    // Cells that coincide are copied to the bit: rounding of the coordinates must not interpolate
    // them.
    const auto snap = [](double c) {
      return std::abs(c - std::round(c)) < snapping ? std::round(c) : c;
    };
    return {snap(at.x), snap(at.y)};
  }

  // Source cells per frame cell along the source's columns and rows, at the centre.
  glm::dvec2 scale() const { return scale_; }

 private:
  void unwrap(double source_centre);
  void find_scale(const RasterFrame& frame);
  void find_offset();

  static constexpr double snapping = 1e-5;  // cells
  CellAffine affine_;
  std::optional<glm::ivec2> offset_;
  glm::ivec2 corner_{0, 0};
  int step_ = 1;
  int across_ = 0;
  std::vector<glm::dvec2> points_;
  glm::dvec2 scale_{1.0, 1.0};
};

}  // namespace belvedere
