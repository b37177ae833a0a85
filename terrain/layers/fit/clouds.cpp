#include "terrain/layers/fit/clouds.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "base/angle.h"
#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "terrain/layers/fit/hue_saturation.h"

namespace belvedere {
namespace {

// Sums of a mask over blocks of factor × factor cells.
Grid<float> reduced(const Grid<std::uint8_t>& mask, int factor) {
  Grid<float> sums((mask.width() + factor - 1) / factor, (mask.height() + factor - 1) / factor,
                   0.0F);
  for (int y = 0; y != mask.height(); ++y)
    for (int x = 0; x != mask.width(); ++x)
      sums(x / factor, y / factor) += static_cast<float>(mask(x, y));
  return sums;
}

struct Match {
  int x = 0;
  int y = 0;
  double correlation = -1.0;
};

// The offset at which `moved` (its non-zero cells) correlates best with `still`, over the cells
// that both cover there, among those `allowed`. Ties take the first in a fixed order of rows.
template <class Allowed>
Match best_offset(const Grid<float>& moved, const Grid<float>& still, int x0, int x1, int y0,
                  int y1, const Allowed& allowed) {
  struct Cell {
    int x, y;
    double value;
  };
  std::vector<Cell> cells;
  double mean_still = 0.0;
  double squares_still = 0.0;
  for (int y = 0; y != moved.height(); ++y)
    for (int x = 0; x != moved.width(); ++x) {
      if (moved(x, y) > 0.0F) cells.push_back({x, y, static_cast<double>(moved(x, y))});
      mean_still += static_cast<double>(still(x, y));
      squares_still += static_cast<double>(still(x, y)) * static_cast<double>(still(x, y));
    }
  const auto count = static_cast<double>(still.size());
  mean_still /= count;
  const double variance_still = squares_still / count - mean_still * mean_still;
  std::vector<Match> best(static_cast<std::size_t>(std::max(0, y1 - y0 + 1)));
  parallel_ranges(best.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row != end; ++row) {
      const int dy = y0 + static_cast<int>(row);
      for (int dx = x0; dx <= x1; ++dx) {
        if (!allowed(dx, dy)) continue;
        double sum = 0.0;
        double squares = 0.0;
        double both = 0.0;
        for (const Cell& c : cells) {
          if (!still.contains(c.x + dx, c.y + dy)) continue;
          sum += c.value;
          squares += c.value * c.value;
          both += c.value * (static_cast<double>(still(c.x + dx, c.y + dy)) - mean_still);
        }
        const double mean = sum / count;
        const double variance = squares / count - mean * mean;
        // Clouds shifted almost entirely out of the picture match by accident.
        if (variance <= 0.0 || variance_still <= 0.0 ||
            squares < 0.3 * static_cast<double>(cells.size()))
          continue;
        const double correlation = both / count / std::sqrt(variance * variance_still);
        if (correlation > best[row].correlation) best[row] = {dx, dy, correlation};
      }
    }
  });
  Match all;
  for (const Match& m : best)
    if (m.correlation > all.correlation) all = m;
  return all;
}

Grid<std::uint8_t> dilated(const Grid<std::uint8_t>& mask, int radius) {
  Grid<float> values(mask.width(), mask.height());
  for (std::size_t i = 0; i != mask.size(); ++i) values[i] = static_cast<float>(mask[i]);
  values = window_maximum(values, radius);
  Grid<std::uint8_t> grown_mask(mask.width(), mask.height());
  for (std::size_t i = 0; i != mask.size(); ++i) grown_mask[i] = values[i] > 0.0F ? 1 : 0;
  return grown_mask;
}

// Single cells and threads are not clouds: an opening by the cell and its four neighbours.
Grid<std::uint8_t> opened(const Grid<std::uint8_t>& mask) {
  const auto cross = [](const Grid<std::uint8_t>& from, bool all) {
    Grid<std::uint8_t> to(from.width(), from.height());
    for (int y = 0; y != from.height(); ++y)
      for (int x = 0; x != from.width(); ++x) {
        const int set = from(x, y) + from.clamped(x - 1, y) + from.clamped(x + 1, y) +
                        from.clamped(x, y - 1) + from.clamped(x, y + 1);
        to(x, y) = (all ? set == 5 : set > 0) ? 1 : 0;
      }
    return to;
  };
  return cross(cross(mask, true), false);
}

}  // namespace

Clouds find_clouds(const Grid<glm::vec3>& picture, double cell_m,
                   const CloudParameters& parameters) {
  constexpr int cloud_rim = 3;
  constexpr int shadow_rim = 8;
  constexpr int coarse_size = 256;  // cells along the longer side of the grid for the full search
  const int width = picture.width();
  const int height = picture.height();
  Grid<std::uint8_t> white(width, height);
  Grid<std::uint8_t> dark(width, height);
  Grid<std::uint8_t> dim(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x != width; ++x) {
      const HueSaturation c = hue_saturation_of(picture(x, y));
      white(x, y) = (c.grey && c.value > parameters.white) ||
                            (c.value > parameters.whitest && c.saturation < parameters.pale)
                        ? 1
                        : 0;
      dark(x, y) = c.value < parameters.dark ? 1 : 0;
      dim(x, y) = c.value < parameters.shadow ? 1 : 0;
    }
  });
  white = opened(white);
  Clouds clouds{false, Grid<std::uint8_t>(width, height, 0), Grid<std::uint8_t>(width, height, 0)};
  const int factor = std::max(1, (std::max(width, height) + coarse_size - 1) / coarse_size);
  const double min = parameters.min_m / cell_m;
  const double max = parameters.max_m / cell_m;
  const auto within = [&](int scale) {
    return [=](int dx, int dy) {
      const double far = exact::hypot(dx, dy) * scale;
      return far >= min && far <= max;
    };
  };
  const int reach = static_cast<int>(max / factor);
  const Grid<float> white_coarse = reduced(white, factor);
  const Grid<float> dark_coarse = reduced(dark, factor);
  const Match coarse =
      best_offset(white_coarse, dark_coarse, -reach, reach, -reach, reach, within(factor));
  if (coarse.correlation <= -1.0) return clouds;
  const Match fine = best_offset(reduced(white, 1), reduced(dark, 1), factor * (coarse.x - 1),
                                 factor * (coarse.x + 1), factor * (coarse.y - 1),
                                 factor * (coarse.y + 1), within(1));
  clouds.match = fine.correlation;
  clouds.shadow_x = fine.x;
  clouds.shadow_y = fine.y;
  const double towards =
      to_degrees(exact::atan2(-static_cast<double>(fine.x), static_cast<double>(fine.y)));
  clouds.sun_azimuth_deg = towards < 0.0 ? towards + 360.0 : towards;
  // Secondary peaks near the maximum are due to the size of the clouds; an equal match farther away
  // means that there is no shadow.
  const int own = coarse_size / 10;
  const auto elsewhere = [&](int dx, int dy) {
    return within(factor)(dx, dy) && exact::hypot(dx - coarse.x, dy - coarse.y) > own;
  };
  clouds.elsewhere =
      best_offset(white_coarse, dark_coarse, -reach, reach, -reach, reach, elsewhere).correlation;
  clouds.found = fine.correlation >= parameters.min_match &&
                 clouds.elsewhere <= parameters.distinct * fine.correlation;
  if (!clouds.found) return clouds;
  Grid<std::uint8_t> moved(width, height, 0);
  for (int y = 0; y != height; ++y)
    for (int x = 0; x != width; ++x)
      if (white(x, y) != 0 && moved.contains(x + fine.x, y + fine.y))
        moved(x + fine.x, y + fine.y) = 1;
  moved = dilated(moved, shadow_rim);
  for (std::size_t i = 0; i != moved.size(); ++i)
    clouds.shadow[i] = moved[i] != 0 && dim[i] != 0 ? 1 : 0;
  clouds.cloud = dilated(white, cloud_rim);
  return clouds;
}

}  // namespace belvedere
