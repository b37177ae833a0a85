#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "terrain/io/raster.h"
#include "terrain/io/raster_file.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// Interpolates a grid with voids (NaN); positions in cells, centres at whole numbers. Private to
// terrain/.
// Keys' cubic convolution (1981, a = -1/2) keeps summits that bilinear means would lower. It is
// stretched if the source is finer than the target, so that it averages. Its result is limited to
// the range of the cells it reads: a lake next to a slope stays flat instead of rippling. Near a
// void, the result is the mean of the known cells under a tent as wide as the sampling distance, or
// void if they have less than half of its weight.
class Resampler {
 public:
  // Source cells per sample along columns and rows; below 1 counts as 1.
  explicit Resampler(glm::dvec2 source_cells_per_sample);

  // Radius in cells that a sample may read.
  glm::ivec2 reach() const;
  float sample(const Grid<float>& cells, glm::dvec2 at) const;

 private:
  float sample_tent(const Grid<float>& cells, glm::dvec2 at) const;

  glm::dvec2 scale_;
};

// The cell that contains the position; -1 outside.
std::int32_t sample_nearest(const Grid<std::int32_t>& cells, glm::dvec2 at);

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
