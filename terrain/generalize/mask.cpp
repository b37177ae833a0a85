#include "terrain/generalize/mask.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/math.h"
#include "base/parallel.h"
#include "base/pyramid.h"
#include "terrain/shape/derivatives.h"

namespace belvedere {
namespace {

// 0 up to `from`, 1 from `to` on.
float share_between(double from, double to, double v) {
  return static_cast<float>(smoothstep(from, to, v));
}

template <class F>
void change_cells(Grid<float>& grid, F&& f) {
  parallel_rows(grid.height(), [&](int y) {
    float* row = grid.row(y);
    for (int x = 0; x < grid.width(); ++x) row[x] = f(row[x], x, y);
  });
}

Grid<float> smooth_slope(const Grid<float>& altitude_m, glm::dvec2 cell_m, double blur_cells,
                         const SlopeBounds& bounds) {
  return slope_deg(gaussian_blur(altitude_m, blur_cells), cell_m.x, cell_m.y, bounds);
}

// 1 on flats and around them, fading over some cells: the foot of a slope is concave and steeper
// than the flat, and belongs to it. Narrow flats, ledges and passes are ignored.
Grid<float> grown_flat(Grid<float> flat) {
  flat = window_maximum(window_minimum(flat, 1), 6);
  return gaussian_blur(flat, 3.0);
}

}  // namespace

Grid<float> slope_mask(const Grid<float>& altitude_m, glm::dvec2 cell_m, const SlopeRange& range) {
  if (!(range.original_to_deg >= 0.0 && range.original_to_deg < range.generalized_from_deg &&
        range.generalized_from_deg < 90.0)) {
    throw Error(ErrorKind::usage, "slope mask",
                fmt::format("from {}° to {}°", range.original_to_deg, range.generalized_from_deg),
                "0° ≤ lower < upper < 90°");
  }
  Grid<float> mask =
      smooth_slope(altitude_m, cell_m, 1.0, {range.original_to_deg, range.generalized_from_deg});
  change_cells(mask, [&](float slope, int, int) {
    return share_between(range.original_to_deg, range.generalized_from_deg, slope);
  });
  Grid<float> flat = mask;
  change_cells(flat, [](float steep, int, int) { return 1.F - steep; });
  flat = grown_flat(std::move(flat));
  change_cells(mask,
               [&](float steep, int x, int y) { return std::clamp(1.F - flat(x, y), 0.F, steep); });
  return mask;
}

Grid<float> class_mask(const Grid<LandCoverClass>& classes, const GeneralizedShares& shares) {
  Grid<float> mask(classes.width(), classes.height());
  change_cells(
      mask, [&](float, int x, int y) { return shares[static_cast<std::size_t>(classes(x, y))]; });
  return mask;
}

Grid<float> slope_foot_mask(const Grid<float>& altitude_m, glm::dvec2 cell_m, int reach_cells) {
  const int reach = std::clamp(reach_cells, 2, 256);
  Grid<float> slope = smooth_slope(altitude_m, cell_m, 1.5, {3.0, 20.0});
  Grid<float> near_steep = slope;
  change_cells(near_steep, [](float s, int, int) { return share_between(12.0, 20.0, s); });
  // Fades outwards over the same distance again.
  near_steep = gaussian_blur(window_maximum(near_steep, reach), 0.35 * reach);
  Grid<float> mask = std::move(slope);
  change_cells(mask, [](float s, int, int) { return 1.F - share_between(3.0, 12.0, s); });
  mask = grown_flat(std::move(mask));
  change_cells(mask, [&](float flat, int x, int y) { return 1.F - flat * near_steep(x, y); });
  return mask;
}

Grid<float> read_mask(const RasterSource& source, const RasterFrame& frame, Progress& progress) {
  RasterSource plain = source;
  plain.unit_to_m = 1.0;  // values, not lengths
  Grid<float> mask = warp_rasters({plain}, frame, progress).cells;
  float lowest = 1.F;
  float highest = 0.F;
  bool any = false;
  for (const float v : mask) {
    if (!std::isfinite(v)) continue;
    any = true;
    lowest = std::min(lowest, v);
    highest = std::max(highest, v);
  }
  if (!any)
    throw Error(ErrorKind::input, source.path, "the mask does not cover the terrain",
                "a mask that covers the terrain");
  if (lowest < 0.F || highest > 255.F) {
    throw Error(ErrorKind::input, source.path,
                fmt::format("the mask's values range from {} to {}", lowest, highest),
                "values from 0 (unchanged) to 1 or 255 (generalized)");
  }
  const float scale = highest > 1.F ? 1.F / 255.F : 1.F;
  change_cells(mask, [&](float v, int, int) { return std::isfinite(v) ? v * scale : 1.F; });
  return mask;
}

Grid<float> soften_mask(const Grid<float>& mask) {
  if (mask.empty()) return {};
  const Grid<float> half = reduce(mask);
  Grid<float> soft =
      expand(expand(reduce(half), half.width(), half.height()), mask.width(), mask.height());
  const Grid<std::int32_t> nearest = nearest_marked(unchanged_cells({}, mask));
  constexpr float fade_cells = 6.F;
  change_cells(soft, [&](float v, int x, int y) {
    const std::int32_t at = nearest(x, y);
    if (at < 0) return v;
    const auto across = static_cast<float>(at % mask.width() - x);
    const auto down = static_cast<float>(at / mask.width() - y);
    return v * smoothstep(std::sqrt(across * across + down * down) / fade_cells);
  });
  return soft;
}

Grid<float> combine_masks(Grid<float> a, const Grid<float>& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  if (!a.same_size(b)) throw Error(ErrorKind::bug, "combine_masks", "the masks differ in size");
  change_cells(a, [&](float v, int x, int y) { return v * b(x, y); });
  return a;
}

Grid<float> apply_mask(const Grid<float>& before, Grid<float> after, const Grid<float>& mask) {
  if (mask.empty()) return after;
  if (!after.same_size(before) || !mask.same_size(before))
    throw Error(ErrorKind::bug, "apply_mask", "the grids differ in size");
  change_cells(after, [&](float v, int x, int y) {
    const float m = mask(x, y);
    const float was = before(x, y);
    return m <= 0.F ? was : m >= 1.F ? v : was + m * (v - was);
  });
  return after;
}

Grid<std::uint8_t> unchanged_cells(const Grid<std::uint8_t>& keep, const Grid<float>& mask) {
  if (mask.empty()) return keep;
  if (!keep.empty() && !keep.same_size(mask))
    throw Error(ErrorKind::bug, "unchanged_cells", "the grids differ in size");
  Grid<std::uint8_t> out(mask.width(), mask.height());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = mask[i] <= 0.F || (!keep.empty() && keep[i] != 0) ? 1 : 0;
  return out;
}

double foreground_share(double distance, double foreground_to, double background_from) {
  constexpr double rounding = 0.125;                // of the span, inside each of its ends
  constexpr double slope = 1.0 / (1.0 - rounding);  // of the line between the corners
  const double t = (distance - foreground_to) / (background_from - foreground_to);
  // Position along a corner: its parabola rises with slope 0 at the start and `slope` at the end.
  const auto corner = [](double along) { return slope * along * along / (2.0 * rounding); };
  if (t <= 0.0) return 1.0;
  if (t < rounding) return 1.0 - corner(t);
  if (t <= 1.0 - rounding) return 0.5 - slope * (t - 0.5);
  if (t < 1.0) return corner(1.0 - t);
  return 0.0;
}

}  // namespace belvedere
