#include "terrain/io/resample.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

#include "base/math_exact.h"
#include "terrain/io/crs.h"

namespace belvedere {
namespace {

constexpr float void_value = std::numeric_limits<float>::quiet_NaN();

double cubic(double distance) {
  const double d = std::abs(distance);
  if (d < 1.0) return (1.5 * d - 2.5) * d * d + 1.0;
  if (d < 2.0) return ((-0.5 * d + 2.5) * d - 4.0) * d + 2.0;
  return 0.0;
}

double tent(double distance) { return std::max(0.0, 1.0 - std::abs(distance)); }

// The first and last whole number within `radius` of `at`.
glm::ivec2 span(double at, double radius) {
  return {static_cast<int>(std::floor(at - radius)) + 1,
          static_cast<int>(std::ceil(at + radius)) - 1};
}

}  // namespace

Resampler::Resampler(glm::dvec2 source_cells_per_sample)
    : scale_(std::max(1.0, source_cells_per_sample.x), std::max(1.0, source_cells_per_sample.y)) {
  // A scale of 1 except for rounding must copy coinciding cells to the bit.
  if (scale_.x < 1.001) scale_.x = 1.0;
  if (scale_.y < 1.001) scale_.y = 1.0;
}

glm::ivec2 Resampler::reach() const {
  return {static_cast<int>(std::ceil(2.0 * scale_.x)) + 1,
          static_cast<int>(std::ceil(2.0 * scale_.y)) + 1};
}

float Resampler::sample(const Grid<float>& cells, glm::dvec2 at) const {
  // More than half a cell outside the grid nothing is known, and positions far outside may not fit
  // an int.
  if (!(at.x > -1.0 && at.y > -1.0 && at.x < cells.width() && at.y < cells.height()))
    return void_value;
  const glm::ivec2 sx = span(at.x, 2.0 * scale_.x);
  const glm::ivec2 sy = span(at.y, 2.0 * scale_.y);
  double total = 0.0;
  double sum = 0.0;
  float low = std::numeric_limits<float>::infinity();
  float high = -low;
  for (int y = sy[0]; y <= sy[1]; ++y) {
    const double wy = cubic((y - at.y) / scale_.y);
    if (wy == 0.0) continue;  // on a row of centres other rows have no weight, void or not
    for (int x = sx[0]; x <= sx[1]; ++x) {
      const double wx = cubic((x - at.x) / scale_.x);
      if (wx == 0.0) continue;
      const float value = cells.contains(x, y) ? cells(x, y) : void_value;
      if (std::isnan(value)) return sample_tent(cells, at);
      low = std::min(low, value);
      high = std::max(high, value);
      total += wx * wy;
      sum += wx * wy * value;
    }
  }
  return std::clamp(static_cast<float>(sum / total), low, high);
}

float Resampler::sample_tent(const Grid<float>& cells, glm::dvec2 at) const {
  const glm::ivec2 sx = span(at.x, scale_.x);
  const glm::ivec2 sy = span(at.y, scale_.y);
  double total = 0.0;
  double known = 0.0;
  double sum = 0.0;
  for (int y = sy[0]; y <= sy[1]; ++y) {
    const double wy = tent((y - at.y) / scale_.y);
    for (int x = sx[0]; x <= sx[1]; ++x) {
      const double weight = wy * tent((x - at.x) / scale_.x);
      total += weight;
      if (!cells.contains(x, y) || std::isnan(cells(x, y))) continue;
      known += weight;
      sum += weight * cells(x, y);
    }
  }
  return known > 0.0 && known >= 0.5 * total ? static_cast<float>(sum / known) : void_value;
}

std::int32_t sample_nearest(const Grid<std::int32_t>& cells, glm::dvec2 at) {
  if (!(at.x >= -0.5 && at.y >= -0.5 && at.x < cells.width() - 0.5 && at.y < cells.height() - 0.5))
    return -1;
  return cells(static_cast<int>(std::floor(at.x + 0.5)), static_cast<int>(std::floor(at.y + 0.5)));
}

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
