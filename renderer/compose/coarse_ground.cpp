#include "renderer/compose/coarse_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "terrain/io/raster_io.h"
#include "terrain/io/surface_raster.h"

namespace belvedere {
namespace {

// Lengths as shares of the side.
constexpr double valley_reach =
    0.10;  // radius within which height above the lowest ground is measured
constexpr double valley_smooth = 0.05;
constexpr double floor_reach = 0.02;  // radius within which a floor is the lowest ground …
constexpr double wall_reach = 0.05;   // … and within which it has mountains
constexpr double narrow_reach =
    0.022;  // valleys narrower than twice this are filled to measure incision

int cells_in(double length_m, double cell_m) {
  return std::max(1, static_cast<int>(std::lround(length_m / cell_m)));
}

// Voids that touch the frame's border, directly or through others: beyond the data. Holes within
// them are not.
Grid<std::uint8_t> inside_data(const Grid<std::uint8_t>& is_void) {
  Grid<std::uint8_t> inside(is_void.width(), is_void.height(), 1);
  std::vector<std::pair<int, int>> todo;
  const auto visit = [&](int x, int y) {
    if (!is_void.contains(x, y) || is_void(x, y) == 0 || inside(x, y) == 0) return;
    inside(x, y) = 0;
    todo.emplace_back(x, y);
  };
  for (int x = 0; x < is_void.width(); ++x) visit(x, 0), visit(x, is_void.height() - 1);
  for (int y = 0; y < is_void.height(); ++y) visit(0, y), visit(is_void.width() - 1, y);
  while (!todo.empty()) {
    const auto [x, y] = todo.back();
    todo.pop_back();
    visit(x - 1, y), visit(x + 1, y), visit(x, y - 1), visit(x, y + 1);
  }
  return inside;
}

// Distance of each cell to the nearest one outside the data or beyond the frame, m.
Grid<float> rim_distance(const Grid<std::uint8_t>& inside, double cell_m) {
  Grid<std::uint8_t> outside(inside.width() + 2, inside.height() + 2, 1);
  for (int y = 0; y < inside.height(); ++y)
    for (int x = 0; x < inside.width(); ++x) outside(x + 1, y + 1) = inside(x, y) != 0 ? 0 : 1;
  const Grid<std::int32_t> nearest = nearest_marked(outside);
  Grid<float> out(inside.width(), inside.height());
  for (int y = 0; y < inside.height(); ++y)
    for (int x = 0; x < inside.width(); ++x) {
      const std::int32_t at = nearest(x + 1, y + 1);
      const double dx = at % outside.width() - (x + 1);
      const double dy = at / outside.width() - (y + 1);
      out(x, y) = static_cast<float>(std::sqrt(dx * dx + dy * dy) * cell_m);
    }
  return out;
}

// Filled holes of a radar's DEM leave single cells between them that rise like summits: a median of
// 5 × 5 around each hole.
void calm_holes(Grid<float>& z, const Grid<std::uint8_t>& hole) {
  constexpr int reach = 2;
  const Grid<float> before = z;
  for (int y = 0; y < z.height(); ++y)
    for (int x = 0; x < z.width(); ++x) {
      bool near = false;
      for (int j = -reach; j <= reach && !near; ++j)
        for (int i = -reach; i <= reach && !near; ++i) near = hole.clamped(x + i, y + j) != 0;
      if (!near) continue;
      std::vector<float> around;
      for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i) around.push_back(before.clamped(x + i, y + j));
      z(x, y) = middle_value(std::move(around));
    }
}

// Level cells in pieces of at least `least`: lakes and the sea.
Grid<std::uint8_t> level_water(const Grid<float>& z, const Grid<std::uint8_t>& inside, int min) {
  constexpr float level_m = 0.6F;  // between the highest and the lowest of 3 × 3 coarse cells
  const Grid<float> low = window_minimum(z, 1);
  const Grid<float> high = window_maximum(z, 1);
  Grid<std::uint8_t> flat(z.width(), z.height(), 0);
  for (std::size_t i = 0; i < z.size(); ++i)
    flat[i] = inside[i] != 0 && high[i] - low[i] <= level_m ? 1 : 0;
  Grid<std::uint8_t> water(z.width(), z.height(), 0);
  Grid<std::uint8_t> seen(z.width(), z.height(), 0);
  std::vector<std::pair<int, int>> piece;
  for (int y = 0; y < z.height(); ++y)
    for (int x = 0; x < z.width(); ++x) {
      if (flat(x, y) == 0 || seen(x, y) != 0) continue;
      piece.assign(1, {x, y});
      seen(x, y) = 1;
      for (std::size_t k = 0; k < piece.size(); ++k) {
        const auto [px, py] = piece[k];
        for (int j = -1; j <= 1; ++j)
          for (int i = -1; i <= 1; ++i) {
            if (!flat.contains(px + i, py + j) || flat(px + i, py + j) == 0 ||
                seen(px + i, py + j) != 0)
              continue;
            if (std::abs(z(px + i, py + j) - z(px, py)) > level_m) continue;
            seen(px + i, py + j) = 1;
            piece.emplace_back(px + i, py + j);
          }
      }
      if (static_cast<int>(piece.size()) < min) continue;
      // A cell's surroundings were tested, so the shore is one cell farther out.
      for (const auto& [px, py] : piece)
        for (int j = -1; j <= 1; ++j)
          for (int i = -1; i <= 1; ++i)
            if (water.contains(px + i, py + j)) water(px + i, py + j) = 1;
    }
  return water;
}

}  // namespace

const GroundCell* CoarseGround::at(glm::dvec2 position) const {
  const double x = (position.x - transform.origin_x) / transform.cell_x;
  const double y = (transform.origin_y - position.y) / transform.cell_y;
  if (!(x >= 0.0 && y >= 0.0 && x < cells.width() && y < cells.height())) return nullptr;
  return &cells(static_cast<int>(x), static_cast<int>(y));
}

double CoarseGround::altitude_m(glm::dvec2 position) const {
  const glm::dvec2 at = transform.to_cell(position.x, position.y);
  const double x = std::clamp(at.x, 0.0, cells.width() - 1.0);
  const double y = std::clamp(at.y, 0.0, cells.height() - 1.0);
  const int i = std::min(static_cast<int>(x), cells.width() - 2);
  const int j = std::min(static_cast<int>(y), cells.height() - 2);
  const double u = x - i;
  const double v = y - j;
  const auto z = [&](int column, int row) {
    return static_cast<double>(cells.clamped(column, row).altitude_m);
  };
  return (1.0 - v) * ((1.0 - u) * z(i, j) + u * z(i + 1, j)) +
         v * ((1.0 - u) * z(i, j + 1) + u * z(i + 1, j + 1));
}

const Grid<float>& CoarseGround::local_relief_m(double radius_m) const {
  const int key =
      static_cast<int>(std::floor(2.0 * exact::log2(std::max(radius_m, 1.0)) + 0.5)) - first_relief;
  return local_reliefs_m[static_cast<std::size_t>(
      std::clamp(key, 0, static_cast<int>(local_reliefs_m.size()) - 1))];
}

CoarseGround make_coarse_ground(Raster<float> raster, double source_cell_m) {
  CoarseGround ground;
  ground.transform = raster.transform;
  ground.crs = raster.crs;
  ground.cell_m = raster.transform.cell_x;
  ground.source_cell_m = source_cell_m;
  Grid<std::uint8_t> is_void(raster.cells.width(), raster.cells.height(), 0);
  for (std::size_t i = 0; i < is_void.size(); ++i) is_void[i] = std::isnan(raster.cells[i]) ? 1 : 0;
  const auto voids =
      static_cast<std::size_t>(std::count(is_void.begin(), is_void.end(), std::uint8_t{1}));
  if (voids == is_void.size())
    throw Error(ErrorKind::input, "the DEM", "has no altitude anywhere",
                "cells with altitudes in metres");
  ground.void_share = static_cast<double>(voids) / static_cast<double>(is_void.size());
  const Grid<std::uint8_t> inside = inside_data(is_void);
  Dem dem = make_dem(std::move(raster));
  Grid<float>& z = dem.altitude_m;
  Grid<std::uint8_t> hole(z.width(), z.height(), 0);
  for (std::size_t i = 0; i < hole.size(); ++i) hole[i] = is_void[i] != 0 && inside[i] != 0 ? 1 : 0;
  if (std::find(hole.begin(), hole.end(), std::uint8_t{1}) != hole.end()) calm_holes(z, hole);

  std::vector<float> known;
  for (std::size_t i = 0; i < z.size(); ++i)
    if (inside[i] != 0) known.push_back(z[i]);
  const double cell = ground.cell_m;
  ground.side_m = std::sqrt(static_cast<double>(known.size())) * cell;
  ground.lowest_m = static_cast<double>(*std::min_element(known.begin(), known.end()));
  ground.highest_m = static_cast<double>(*std::max_element(known.begin(), known.end()));
  ground.low_m = static_cast<double>(value_at_share(known, 0.05));
  ground.upper_m = static_cast<double>(value_at_share(known, 0.999));
  ground.relief_m = std::max(1.0, static_cast<double>(value_at_share(known, 0.97)) - ground.low_m);

  const double side = ground.side_m;
  const Grid<float> rim = rim_distance(inside, cell);
  const Grid<float> valleys = gaussian_blur(window_minimum(z, cells_in(valley_reach * side, cell)),
                                            valley_smooth * side / cell);
  const Grid<float> near_low = window_minimum(z, cells_in(floor_reach * side, cell));
  const Grid<float> wall_high = window_maximum(z, cells_in(wall_reach * side, cell));
  // Closing (Serra 1982): narrow valleys filled.
  const int narrow = cells_in(narrow_reach * side, cell);
  const Grid<float> closed = window_minimum(window_maximum(z, narrow), narrow);
  const Grid<float> wall_low = window_minimum(z, cells_in(wall_reach * side, cell));
  constexpr double min_water = 0.0012;  // of the region
  const int min = std::max(12, static_cast<int>(min_water * side * side / (cell * cell)));
  const Grid<std::uint8_t> water = level_water(z, inside, min);

  ground.cells = Grid<GroundCell>(z.width(), z.height());
  double upper_slope = 0.0, upper_count = 0.0, flank_slope = 0.0, flank_count = 0.0;
  const double steepest = 0.1139;  // 6.5°
  for (int y = 0; y < z.height(); ++y)
    for (int x = 0; x < z.width(); ++x) {
      GroundCell& c = ground.cells(x, y);
      c.altitude_m = z(x, y);
      c.above_m = z(x, y) - valleys(x, y);
      c.incision_m = closed(x, y) - z(x, y);
      c.known = inside(x, y) != 0;
      c.rim_m = c.known ? rim(x, y) : 0.F;
      c.water = water(x, y) != 0 && c.known;
      const double dx =
          static_cast<double>(z.clamped(x + 1, y) - z.clamped(x - 1, y)) / (2.0 * cell);
      const double dy =
          static_cast<double>(z.clamped(x, y + 1) - z.clamped(x, y - 1)) / (2.0 * cell);
      constexpr double max_above = 0.05, min_below = 0.14;  // of the relief
      c.floor = dx * dx +
                dy *
                    dy<steepest * steepest&& static_cast<double>(z(x, y) - near_low(x, y)) <
                       max_above * ground.relief_m&& static_cast<double>(wall_high(x, y) - z(x, y))>
                        min_below * ground.relief_m;
      if (!c.known || static_cast<double>(c.rim_m) < narrow_reach * side) continue;
      // Position between the lowest and the highest around.
      const double local = static_cast<double>(wall_high(x, y) - wall_low(x, y));
      constexpr double min_local = 0.25;  // of the relief
      if (local < min_local * ground.relief_m) continue;
      const double share = static_cast<double>(z(x, y) - wall_low(x, y)) / local;
      const double slope = std::sqrt(dx * dx + dy * dy);
      const double weight = local / ground.relief_m;
      if (share > 0.75) upper_slope += weight * slope, upper_count += weight;
      if (share > 0.25 && share < 0.6) flank_slope += weight * slope, flank_count += weight;
    }
  // Mountains are about as steep at the top as on their flanks; uplands between canyons are flat.
  const double ratio = (upper_slope / std::max(1e-6, upper_count)) /
                       std::max(1e-6, flank_slope / std::max(1e-6, flank_count));
  ground.plateau = unit((0.83 - ratio) / 0.13);

  constexpr double smallest = 0.012, largest = 0.14;  // radii used, of the side
  ground.first_relief =
      static_cast<int>(std::floor(2.0 * exact::log2(std::max(1.0, smallest * side))));
  const int last = static_cast<int>(std::ceil(2.0 * exact::log2(std::max(1.0, largest * side))));
  for (int key = ground.first_relief; key <= last; ++key) {
    const int reach = cells_in(exact::exp2(0.5 * key), cell);
    Grid<float> relief = window_maximum(z, reach);
    const Grid<float> low = window_minimum(z, reach);
    for (std::size_t i = 0; i < relief.size(); ++i) relief[i] -= low[i];
    ground.local_reliefs_m.push_back(std::move(relief));
  }
  return ground;
}

namespace {

// Files with this many cells are sampled instead of being read.
constexpr double max_read_cells = 24e6;
constexpr int looks_per_cell = 4;  // samples per side of a coarse cell

// Means of the samples in each coarse cell, of the first source with data there. Empty where a file
// cannot be sampled.
std::optional<Raster<float>> look_at_files(const DemParameters& dem, const RasterFrame& frame,
                                           int longest, Progress& progress) {
  Raster<float> out{Grid<float>(frame.width, frame.height, std::numeric_limits<float>::quiet_NaN()),
                    frame.transform, frame.crs};
  for (const RasterSource& source : dem.sources) {
    const std::optional<Raster<float>> thin = read_thinned(source, longest, progress);
    if (!thin) return std::nullopt;
    const PointTransform transform(frame.crs, thin->crs);
    std::vector<glm::dvec2> centres;
    for (int y = 0; y < frame.height; ++y)
      for (int x = 0; x <= frame.width; ++x) centres.push_back(frame.transform.to_crs(x, y));
    transform.apply(centres);
    for (int y = 0; y < frame.height; ++y)
      for (int x = 0; x < frame.width; ++x) {
        const std::size_t i =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width + 1) +
            static_cast<std::size_t>(x);
        if (!std::isnan(out.cells(x, y)) || !std::isfinite(centres[i].x) ||
            !std::isfinite(centres[i + 1].x))
          continue;
        const glm::dvec2 at = thin->transform.to_cell(centres[i].x, centres[i].y);
        const glm::dvec2 next = thin->transform.to_cell(centres[i + 1].x, centres[i + 1].y);
        if (at.x < -1.0 || at.y < -1.0 || at.x > thin->cells.width() || at.y > thin->cells.height())
          continue;
        const int reach =
            std::clamp(static_cast<int>(std::lround(0.5 * std::abs(next.x - at.x) - 0.5)), 0,
                       2 * looks_per_cell);
        const int column = static_cast<int>(std::lround(at.x));
        const int row = static_cast<int>(std::lround(at.y));
        double sum = 0.0;
        int count = 0, all = 0;
        for (int j = -reach; j <= reach; ++j)
          for (int k = -reach; k <= reach; ++k) {
            ++all;
            if (!thin->cells.contains(column + k, row + j) ||
                std::isnan(thin->cells(column + k, row + j)))
              continue;
            sum += static_cast<double>(thin->cells(column + k, row + j));
            ++count;
          }
        if (2 * count >= all) out.cells(x, y) = static_cast<float>(sum / count);
      }
  }
  return out;
}

}  // namespace

CoarseGround read_coarse_ground(const DemParameters& given, Progress& progress,
                                const CoarseGroundParameters& parameters) {
  DemParameters dem = given;
  dem.sources = check_height_sources(given.sources, progress);
  RasterFrame frame = choose_frame(dem.sources, dem.crs, dem.cell_m, dem.extent);
  const auto checked = [&](Raster<float> raster, double cell_m) {
    CoarseGround ground = make_coarse_ground(std::move(raster), cell_m);
    note_height_range(dem.sources[0].path, static_cast<float>(ground.lowest_m),
                      static_cast<float>(ground.highest_m), progress);
    return ground;
  };
  const double source_cell_m = frame.transform.cell_x;
  const bool look = !dem.extent && static_cast<double>(frame.width) * frame.height > max_read_cells;
  const double width_m = frame.width * frame.transform.cell_x;
  const double height_m = frame.height * frame.transform.cell_y;
  const double cell_m = std::max({frame.transform.cell_x, frame.transform.cell_y,
                                  std::max(width_m, height_m) / parameters.max_cells});
  frame.transform.cell_x = frame.transform.cell_y = cell_m;
  frame.width = std::max(2, static_cast<int>(std::ceil(width_m / cell_m - 1e-6)));
  frame.height = std::max(2, static_cast<int>(std::ceil(height_m / cell_m - 1e-6)));
  if (look)
    if (std::optional<Raster<float>> seen =
            look_at_files(dem, frame, looks_per_cell * parameters.max_cells, progress))
      return checked(std::move(*seen), source_cell_m);
  return checked(warp_rasters(dem.sources, frame, progress), source_cell_m);
}

CoarseAltitudes coarse_altitudes_of(const Dem& dem, const CoarseGroundParameters& parameters) {
  BlockMeans means(dem.width(), dem.height(), parameters.max_cells);
  constexpr int strip_rows = 512;
  for (int first = 0; first < dem.height(); first += strip_rows) {
    Grid<float> known(dem.width(), std::min(strip_rows, dem.height() - first));
    parallel_rows(known.height(), [&](int y) {
      for (int x = 0; x < known.width(); ++x)
        known(x, y) = dem.filled(x, first + y) != 0 ? std::numeric_limits<float>::quiet_NaN()
                                                    : dem.altitude_m(x, first + y);
    });
    means.push(known);
  }
  GeoTransform transform = dem.transform;
  transform.cell_x *= means.factor();
  transform.cell_y *= means.factor();
  return {{means.means(), transform, dem.crs}, dem.cell_m()};
}

CoarseGround coarse_ground_of(const CoarseAltitudes& altitudes,
                              const std::function<glm::dvec3(glm::dvec3)>& move) {
  Raster<float> raster = altitudes.blocks;
  if (move) raster.cells = raster_of_moved(raster.cells, raster.transform, move);
  return make_coarse_ground(std::move(raster), altitudes.source_cell_m);
}

}  // namespace belvedere
