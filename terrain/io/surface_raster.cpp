#include "terrain/io/surface_raster.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <vector>

#include "base/parallel.h"

namespace belvedere {
namespace {

constexpr int band_rows = 64;

// Draws a facet into rows y0 … y1 - 1, keeping the highest z where facets overlap. Corners in cells
// and metres.
void draw(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, int y0, int y1,
          Grid<float>& out) {
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (!(std::abs(area) > 0.0)) return;
  const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
  const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
  if (!(high_x >= 0.0 && low_x <= out.width() - 1.0 && high_y >= y0 && low_y <= y1 - 1.0)) return;
  const int first_x = static_cast<int>(std::ceil(std::max(low_x, 0.0)));
  const int last_x = static_cast<int>(std::floor(std::min(high_x, out.width() - 1.0)));
  const int first_y = static_cast<int>(std::ceil(std::max(low_y, static_cast<double>(y0))));
  const int last_y = static_cast<int>(std::floor(std::min(high_y, y1 - 1.0)));
  constexpr double rounding = 1e-9;  // facets share their edges: a centre on one belongs to both
  for (int y = first_y; y <= last_y; ++y) {
    for (int x = first_x; x <= last_x; ++x) {
      const double v = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
      const double w = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
      if (v < -rounding || w < -rounding || v + w > 1.0 + rounding) continue;
      const auto z = static_cast<float>(a.z + v * (b.z - a.z) + w * (c.z - a.z));
      float& cell = out(x, y);
      if (std::isnan(cell) || z > cell) cell = z;
    }
  }
}

}  // namespace

Grid<float> raster_of_moved(const Grid<float>& altitude_m, const GeoTransform& transform,
                            const std::function<glm::dvec3(glm::dvec3)>& move) {
  const int width = altitude_m.width();
  const int height = altitude_m.height();
  // Displacement of each post in plan (in cells, so that an unmoved post lies exactly on its cell)
  // and its new height.
  Grid<glm::vec3> moved(width, height);
  struct Reach {
    float low = 0.F, high = 0.F;
    bool moves = false;
  };
  std::vector<Reach> reach(static_cast<std::size_t>(height));
  parallel_rows(height, [&](int y) {
    Reach& row = reach[static_cast<std::size_t>(y)];
    for (int x = 0; x < width; ++x) {
      const glm::dvec2 position = transform.to_crs(x, y);
      const glm::dvec3 to = move({position, altitude_m(x, y)});
      const glm::vec3 step((to.x - position.x) / transform.cell_x,
                           (position.y - to.y) / transform.cell_y, to.z);
      moved(x, y) = step;
      row.low = std::min(row.low, step.y);
      row.high = std::max(row.high, step.y);
      row.moves = row.moves || step.x != 0.F || step.y != 0.F;
    }
  });
  Grid<float> out(width, height, std::numeric_limits<float>::quiet_NaN());
  if (std::none_of(reach.begin(), reach.end(), [](const Reach& row) { return row.moves; })) {
    parallel_rows(height, [&](int y) {
      for (int x = 0; x < width; ++x) out(x, y) = moved(x, y).z;
    });
    return out;
  }
  const auto corner = [&](int x, int y) { return glm::dvec3(x, y, 0.0) + glm::dvec3(moved(x, y)); };
  parallel_rows((height + band_rows - 1) / band_rows, [&](int band) {
    const int y0 = band * band_rows;
    const int y1 = std::min(y0 + band_rows, height);
    for (int y = 0; y + 1 < height; ++y) {
      const Reach& above = reach[static_cast<std::size_t>(y)];
      const Reach& below = reach[static_cast<std::size_t>(y) + 1];
      const double low = std::min(static_cast<double>(y) + above.low, y + 1.0 + below.low);
      const double high = std::max(static_cast<double>(y) + above.high, y + 1.0 + below.high);
      if (high < y0 || low > y1 - 1.0) continue;
      for (int x = 0; x + 1 < width; ++x) {
        const glm::dvec3 nw = corner(x, y);
        const glm::dvec3 ne = corner(x + 1, y);
        const glm::dvec3 sw = corner(x, y + 1);
        const glm::dvec3 se = corner(x + 1, y + 1);
        draw(nw, ne, sw, y0, y1, out);
        draw(se, sw, ne, y0, y1, out);
      }
    }
  });
  return out;
}

}  // namespace belvedere
