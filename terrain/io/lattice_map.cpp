#include "terrain/io/lattice_map.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "base/math_exact.h"
#include "terrain/io/crs.h"

namespace belvedere {

LatticeMap::LatticeMap(const CellAffine& source, const std::string& source_crs, glm::dvec2 centre,
                       const RasterFrame& frame)
    : affine_(source) {
  const bool equal = same_crs(source_crs, frame.crs);
  const double cell_m = std::max(frame.transform.cell_x, frame.transform.cell_y);
  constexpr double earth_radius_m = 6.371e6;
  step_ =
      equal ? 64 : std::clamp(static_cast<int>(std::sqrt(2e-3 * earth_radius_m / cell_m)), 1, 32);
  across_ = (frame.width - 1) / step_ + 2;
  const int down = (frame.height - 1) / step_ + 2;
  points_.reserve(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down));
  for (int j = 0; j < down; ++j)
    for (int i = 0; i < across_; ++i)
      points_.push_back(frame.transform.to_crs(i * step_, j * step_));
  if (!equal) {
    PointTransform(frame.crs, source_crs).apply(points_);
    if (!source_crs.empty() && crs_traits(source_crs).geographic) unwrap(centre.x);
  }
  for (glm::dvec2& point : points_) point = affine_.to_cell(point) - glm::dvec2{0.5, 0.5};
  find_scale(frame);
  find_offset();
}

// Longitudes without a jump over the frame, in the turn nearest to the source.
void LatticeMap::unwrap(double source_centre) {
  const glm::dvec2 centre = points_[points_.size() / 2];
  const double shift =
      std::isfinite(centre.x) ? 360.0 * std::round((source_centre - centre.x) / 360.0) : 0.0;
  for (glm::dvec2& point : points_)
    point.x += shift - 360.0 * std::round((point.x - centre.x) / 360.0);
}

void LatticeMap::find_scale(const RasterFrame& frame) {
  const int i = std::min(across_ - 2, (frame.width / 2) / step_);
  const int down = static_cast<int>(points_.size()) / across_;
  const int j = std::min(down - 2, (frame.height / 2) / step_);
  const glm::dvec2* p =
      points_.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(across_) + i;
  const glm::dvec2 east = (p[1] - p[0]) / static_cast<double>(step_);
  const glm::dvec2 south = (p[across_] - p[0]) / static_cast<double>(step_);
  scale_ = {exact::hypot(east.x, south.x), exact::hypot(east.y, south.y)};
  if (!std::isfinite(scale_.x) || !std::isfinite(scale_.y)) scale_ = {1.0, 1.0};
}

void LatticeMap::find_offset() {
  const glm::dvec2 first = glm::round(points_[0]);
  if (!(std::abs(first.x) < 1e8 && std::abs(first.y) < 1e8)) return;
  // Half of the snapping distance: positions in between are as close as the points around them,
  // except for rounding.
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const auto across = static_cast<std::size_t>(across_);
    const glm::dvec2 whole =
        first + static_cast<double>(step_) * glm::dvec2{k % across, k / across};
    if (!(std::abs(points_[k].x - whole.x) < 0.5 * snapping &&
          std::abs(points_[k].y - whole.y) < 0.5 * snapping))
      return;
  }
  offset_ = glm::ivec2(first);
}

}  // namespace belvedere
