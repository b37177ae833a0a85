#include "renderer/features/footprint.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "base/grid.h"
#include "base/masks/polygon.h"

namespace belvedere {
namespace {

constexpr double nearly_rectangle =
    0.86;                          // of the bounding rectangle: bays and porches are not wings
constexpr double min_gain = 0.05;  // of the house: min area that a further wing adds
constexpr double min_cover = 0.7;  // of the house: min area of all wings together
constexpr int max_wings = 8;
constexpr std::size_t max_lines = 14;  // of the grid in each direction
constexpr double same_line =
    0.05;  // of the rectangle's shorter side: closer corners are on one line

// Coordinates of corners, with close ones merged.
std::vector<double> lines_through(std::vector<double> values, double min) {
  std::sort(values.begin(), values.end());
  std::vector<double> lines = {values.front()};
  for (const double value : values)
    if (value - lines.back() > min) lines.push_back(value);
  const double last = values.back();
  if (lines.size() > 1 && last > lines.back()) lines.back() = last;
  if (lines.size() <= max_lines) return lines;
  lines.clear();
  for (std::size_t k = 0; k < max_lines; ++k)
    lines.push_back(values.front() + (last - values.front()) * static_cast<double>(k) /
                                         static_cast<double>(max_lines - 1));
  return lines;
}

// The house in its own axes, as a grid through its corners whose cells are inside or outside.
struct Net {
  std::vector<double> x, y;
  Grid<std::uint8_t> inside;
  Grid<std::uint8_t> covered;

  double area(int column, int row) const {
    return (x[static_cast<std::size_t>(column) + 1] - x[static_cast<std::size_t>(column)]) *
           (y[static_cast<std::size_t>(row) + 1] - y[static_cast<std::size_t>(row)]);
  }
  double open_area() const {
    double sum = 0.0;
    for (int r = 0; r < inside.height(); ++r)
      for (int c = 0; c < inside.width(); ++c)
        sum += inside(c, r) != 0 && covered(c, r) == 0 ? area(c, r) : 0.0;
    return sum;
  }
};

Net net_of(const std::vector<std::vector<glm::dvec2>>& rings, double min) {
  Net net;
  std::vector<double> x;
  std::vector<double> y;
  for (const auto& ring : rings)
    for (const glm::dvec2 corner : ring) {
      x.push_back(corner.x);
      y.push_back(corner.y);
    }
  net.x = lines_through(std::move(x), min);
  net.y = lines_through(std::move(y), min);
  const int columns = static_cast<int>(net.x.size()) - 1;
  const int rows = static_cast<int>(net.y.size()) - 1;
  if (columns < 1 || rows < 1) return net;
  net.inside = Grid<std::uint8_t>(columns, rows, 0);
  net.covered = net.inside;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const auto i = static_cast<std::size_t>(c);
      const auto j = static_cast<std::size_t>(r);
      net.inside(c, r) =
          encloses(rings, {0.5 * (net.x[i] + net.x[i + 1]), 0.5 * (net.y[j] + net.y[j + 1])}) ? 1
                                                                                              : 0;
    }
  return net;
}

struct Wing {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // cells of the grid
  double gain = 0.0;                   // area that no other wing covers
  double area = 0.0;
};

// The rectangle of inside cells that covers most uncovered area; of equal ones the largest, then
// the first.
Wing best_wing(const Net& net) {
  Wing best;
  for (int y0 = 0; y0 < net.inside.height(); ++y0)
    for (int x0 = 0; x0 < net.inside.width(); ++x0) {
      int max_x = net.inside.width();
      std::vector<double> gain(static_cast<std::size_t>(max_x), 0.0);
      std::vector<double> area = gain;
      for (int y1 = y0; y1 < net.inside.height(); ++y1) {
        double row_gain = 0.0;
        double row_area = 0.0;
        for (int x1 = x0; x1 < max_x; ++x1) {
          if (net.inside(x1, y1) == 0) {
            max_x = x1;
            break;
          }
          row_area += net.area(x1, y1);
          row_gain += net.covered(x1, y1) == 0 ? net.area(x1, y1) : 0.0;
          const auto k = static_cast<std::size_t>(x1);
          gain[k] += row_gain;
          area[k] += row_area;
          const double more = 1.0 + 1e-6;
          if (gain[k] > best.gain * more ||
              (gain[k] * more > best.gain && area[k] > best.area * more))
            best = {
                .x0 = x0, .y0 = y0, .x1 = x1 + 1, .y1 = y1 + 1, .gain = gain[k], .area = area[k]};
        }
      }
    }
  return best;
}

}  // namespace

Footprint footprint_of(const std::vector<glm::dvec2>& outline) {
  Footprint best;
  double min = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 edge = outline[(i + 1) % outline.size()] - outline[i];
    if (glm::length(edge) < 1e-6) continue;
    const glm::dvec2 u = glm::normalize(edge);
    const glm::dvec2 v = perpendicular(u);
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high = -low;
    for (const glm::dvec2 corner : outline) {
      const glm::dvec2 at{glm::dot(corner - outline[0], u), glm::dot(corner - outline[0], v)};
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
    const glm::dvec2 size = high - low;
    if (size.x * size.y >= min * (1.0 - 1e-9)) continue;
    min = size.x * size.y;
    const glm::dvec2 centre = 0.5 * (low + high);
    best.centre = outline[0] + centre.x * u + centre.y * v;
    best.along = 0.5 * size.x * u;
    best.across = 0.5 * size.y * v;
  }
  if (glm::length(best.along) < glm::length(best.across)) std::swap(best.along, best.across);
  return best;
}

std::vector<Footprint> wings_of(const std::vector<std::vector<glm::dvec2>>& rings) {
  const Footprint whole = footprint_of(rings.front());
  const double half_width = glm::length(whole.across);
  const double half_length = glm::length(whole.along);
  if (half_width < 1e-6 || rings.front().size() + rings.size() < 6) return {whole};
  const glm::dvec2 u = whole.along / half_length;
  const glm::dvec2 v = whole.across / half_width;
  std::vector<std::vector<glm::dvec2>> own = rings;
  for (auto& ring : own)
    for (glm::dvec2& corner : ring)
      corner = {glm::dot(corner - whole.centre, u), glm::dot(corner - whole.centre, v)};
  Net net = net_of(own, same_line * 2.0 * half_width);
  const double all = net.inside.empty() ? 0.0 : net.open_area();
  if (all <= 0.0 || all > nearly_rectangle * 4.0 * half_length * half_width) return {whole};
  std::vector<Footprint> wings;
  for (int k = 0; k < max_wings; ++k) {
    const Wing wing = best_wing(net);
    if (wing.gain < min_gain * all) break;
    for (int y = wing.y0; y < wing.y1; ++y)
      for (int x = wing.x0; x < wing.x1; ++x) net.covered(x, y) = 1;
    const auto at = [](const std::vector<double>& lines, int i) {
      return lines[static_cast<std::size_t>(i)];
    };
    const glm::dvec2 low{at(net.x, wing.x0), at(net.y, wing.y0)};
    const glm::dvec2 high{at(net.x, wing.x1), at(net.y, wing.y1)};
    const glm::dvec2 centre = 0.5 * (low + high);
    const glm::dvec2 half = 0.5 * (high - low);
    Footprint foot{.centre = whole.centre + centre.x * u + centre.y * v,
                   .along = half.x * u,
                   .across = half.y * v};
    if (half.x < half.y) std::swap(foot.along, foot.across);
    wings.push_back(foot);
  }
  if (wings.empty() || net.open_area() > (1.0 - min_cover) * all) return {whole};
  return wings;
}

}  // namespace belvedere
