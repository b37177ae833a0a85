#include "terrain/io/dem_levels.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/pyramid.h"

namespace belvedere {
namespace {

constexpr int strip_rows = 512;  // of level 0, read at once
constexpr std::array<float, 5> kernel = {0.05F, 0.25F, 0.4F, 0.25F, 0.05F};

PixelRect whole_of(const RasterFrame& frame, int level) {
  return {0, 0, level_cells(frame.width, level), level_cells(frame.height, level)};
}

// Removes the rows before `from`.
Grid<float> rows_of(const Grid<float>& grid, int from, int to) {
  Grid<float> out(grid.width(), std::max(to - from, 0));
  if (out.height() > 0) std::copy(grid.row(from), grid.row(from) + out.size(), out.begin());
  return out;
}

// One grid below the other.
Grid<float> joined(const Grid<float>& above, const Grid<float>& below) {
  if (above.empty()) return below;
  if (below.empty()) return above;
  Grid<float> out(above.width(), above.height() + below.height());
  std::copy(below.begin(), below.end(), std::copy(above.begin(), above.end(), out.begin()));
  return out;
}

// Mean of the known cells around (x, y), by the kernel's weights.
float known_mean(const Grid<float>& rows, int x, int y) {
  float sum = 0.F;
  float weight = 0.F;
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i) {
      if (!rows.contains(x + i, y + j)) continue;
      const float z = rows(x + i, y + j);
      if (std::isnan(z)) continue;
      const float w =
          kernel[static_cast<std::size_t>(i + 2)] * kernel[static_cast<std::size_t>(j + 2)];
      sum += w * z;
      weight += w;
    }
  return weight >= 0.5F ? sum / weight : std::numeric_limits<float>::quiet_NaN();
}

// Rows of `columns` values with two more on either side, extended linearly as in base/pyramid.cpp.
void extend_row(float* row, int count) {
  for (int i = 1; i <= 2; ++i) {
    if (count == 1) {
      row[-i] = row[i] = row[0];
    } else if (count == 2) {
      row[-i] = row[0] + static_cast<float>(i) * (row[0] - row[1]);
      row[1 + i] = row[1] + static_cast<float>(i) * (row[1] - row[0]);
    } else {
      row[-i] = 2.F * row[0] - row[i];
      row[count - 1 + i] = 2.F * row[count - 1] - row[count - 1 - i];
    }
  }
}

// A membrane over the void cells; coarse values are relaxed against the borders.
void resolve(Grid<float>& z, const Grid<std::uint8_t>& filled) {
  std::vector<std::size_t> voids;
  for (std::size_t i = 0; i < filled.size(); ++i)
    if (filled[i] != 0) voids.push_back(i);
  relax_voids(z, voids);
}

}  // namespace

int level_cells(int cells, int level) {
  for (int i = 0; i < level; ++i) cells = (cells + 1) / 2;
  return cells;
}

int coarsest_level(const RasterFrame& frame, double max_cells) {
  const auto cells = [&](int level) {
    return static_cast<double>(level_cells(frame.width, level)) * level_cells(frame.height, level);
  };
  if (cells(0) <= max_cells) return 0;
  int level = 1;
  constexpr double share_of_whole = 0.25;
  constexpr int fewest_cells = 256;  // on a side: minimum of a useful landscape
  while (cells(level) > share_of_whole * max_cells &&
         std::min(level_cells(frame.width, level), level_cells(frame.height, level)) > fewest_cells)
    ++level;
  return level;
}

int preview_level(const RasterFrame& frame, double max_cells) {
  constexpr double a_third_more = 0.2;  // halvings
  constexpr int fewest_cells = 16;      // on a side
  const double cells = static_cast<double>(frame.width) * frame.height;
  if (!(max_cells > 0.0) || cells <= max_cells) return 0;
  int level = static_cast<int>(std::ceil(0.5 * exact::log2(cells / max_cells) - a_third_more));
  while (level > 0 && level_cells(std::min(frame.width, frame.height), level) < fewest_cells)
    --level;
  return level;
}

Dem halved_dem(const Dem& dem, int times) {
  if (times < 1) return dem;
  Dem out;
  out.altitude_m = reduce(dem.altitude_m);
  for (int i = 1; i < times; ++i) out.altitude_m = reduce(out.altitude_m);
  const int step = 1 << times;
  const Grid<float>& z = dem.altitude_m;
  if (!dem.filled.empty()) out.filled = Grid<std::uint8_t>(out.width(), out.height());
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      const float level_m = z(step * x, step * y);
      if (!dem.filled.empty()) out.filled(x, y) = dem.filled(step * x, step * y);
      int level = 0;
      int cells = 0;
      for (int v = step * y - step / 2; v < std::min(step * y + step / 2, dem.height()); ++v)
        for (int u = step * x - step / 2; u < std::min(step * x + step / 2, dem.width()); ++u) {
          if (u < 0 || v < 0) continue;
          ++cells;
          level += z(u, v) == level_m ? 1 : 0;
        }
      if (4 * level >= 3 * cells) out.altitude_m(x, y) = level_m;
    }
  });
  const RasterFrame frame = level_frame({dem.transform, dem.width(), dem.height(), dem.crs}, times);
  out.transform = frame.transform;
  out.crs = dem.crs;
  out.halved = dem.halved + times;
  return out;
}

double reading_bytes(const RasterFrame& frame) {
  constexpr double strips = 3.0;  // as read, with the rows kept for it, and the result
  return strips * sizeof(float) * std::min(strip_rows, frame.height) *
         static_cast<double>(frame.width);
}

RasterFrame level_frame(const RasterFrame& frame, int level) {
  RasterFrame out = frame;
  const double factor = std::ldexp(1.0, level);
  const GeoTransform& t = frame.transform;
  out.width = level_cells(frame.width, level);
  out.height = level_cells(frame.height, level);
  // The centres of the first cells coincide.
  out.transform = {t.origin_x + 0.5 * t.cell_x * (1.0 - factor),
                   t.origin_y - 0.5 * t.cell_y * (1.0 - factor), t.cell_x * factor,
                   t.cell_y * factor};
  return out;
}

Grid<float> DemRowReducer::push(const Grid<float>& rows) {
  const Grid<float> known = joined(kept_, rows);
  const int end = first_ + known.height();
  const bool last = end >= height_;
  const int to = last ? (height_ + 1) / 2 : std::max(made_, (end - 1) / 2);  // row y needs 2 y + 2
  Grid<float> out((width_ + 1) / 2, to - made_);
  parallel_rows(out.height(), [&](int row) {
    const int centre = 2 * (made_ + row);
    std::array<std::vector<float>, 5> spare;
    std::array<const float*, 5> lines{};
    for (int j = -2; j <= 2; ++j) {
      const int y = centre + j;
      const auto k = static_cast<std::size_t>(j + 2);
      const int edge = std::clamp(y, 0, height_ - 1);
      if (y == edge || height_ == 1) {
        lines[k] = known.row(edge - first_);
        continue;
      }
      const int beyond = std::abs(y - edge);
      const int inner = height_ == 2 ? 1 - edge : (y < 0 ? beyond : height_ - 1 - beyond);
      const float weight = height_ == 2 ? static_cast<float>(beyond) : 1.F;
      const float* a = known.row(edge - first_);
      const float* b = known.row(inner - first_);
      spare[k].resize(static_cast<std::size_t>(width_));
      for (int x = 0; x < width_; ++x)
        spare[k][static_cast<std::size_t>(x)] = a[x] + weight * (a[x] - b[x]);
      lines[k] = spare[k].data();
    }
    const auto& [a, b, c, d, e] = lines;
    std::vector<float> padded(static_cast<std::size_t>(width_) + 4);
    float* column = padded.data() + 2;
    for (int x = 0; x < width_; ++x)
      column[x] = 0.4F * c[x] + 0.25F * (b[x] + d[x]) + 0.05F * (a[x] + e[x]);
    extend_row(column, width_);
    float* target = out.row(row);
    for (int x = 0; x < out.width(); ++x) {
      const float* v = column + std::ptrdiff_t{2} * x;
      target[x] = 0.4F * v[0] + 0.25F * (v[-1] + v[1]) + 0.05F * (v[-2] + v[2]);
      if (std::isnan(target[x])) target[x] = known_mean(known, 2 * x, centre - first_);
    }
  });
  made_ = to;
  const int keep_from = std::clamp(2 * made_ - 2, first_, end);
  kept_ = last ? Grid<float>() : rows_of(known, keep_from - first_, known.height());
  first_ = keep_from;
  return out;
}

DemLevels::DemLevels(const DemParameters& parameters, const RasterFrame& frame, int coarsest,
                     double kept_cells, Progress& progress)
    : windows_(check_height_sources(parameters.sources, progress), frame),
      coarsest_(coarsest),
      first_kept_(coarsest),
      blocks_(frame.width, frame.height) {
  if (coarsest < 1 || coarsest > 16)
    throw Error(ErrorKind::bug, "levels of a DEM", fmt::format("{} levels", coarsest), "1 to 16");
  const auto cells = [&](int level) {
    return static_cast<double>(level_frame(frame, level).width) * level_frame(frame, level).height;
  };
  for (double held = cells(coarsest);
       first_kept_ > 1 && held + cells(first_kept_ - 1) <= kept_cells; --first_kept_)
    held += cells(first_kept_ - 1);
  std::vector<DemRowReducer> reducers;
  std::vector<int> rows_made(static_cast<std::size_t>(coarsest) + 1, 0);
  for (int level = 0; level < coarsest; ++level)
    reducers.emplace_back(level_cells(frame.width, level), level_cells(frame.height, level));
  for (int level = first_kept_; level <= coarsest; ++level)
    kept_.emplace_back(level_cells(frame.width, level), level_cells(frame.height, level));

  progress.begin("read terrain", frame.height);
  double voids = 0.0;
  float lowest_m = std::numeric_limits<float>::infinity();
  float highest_m = -lowest_m;
  for (int y = 0; y < frame.height; y += strip_rows) {
    Grid<float> rows = windows_.read({0, y, frame.width, std::min(y + strip_rows, frame.height)});
    voids += static_cast<double>(
        std::count_if(rows.begin(), rows.end(), [](float z) { return std::isnan(z); }));
    for (const float z : rows) {
      lowest_m = z < lowest_m ? z : lowest_m;
      highest_m = z > highest_m ? z : highest_m;
    }
    const int read = rows.height();
    blocks_.push(rows);
    for (int level = 1; level <= coarsest && !rows.empty(); ++level) {
      rows = reducers[static_cast<std::size_t>(level) - 1].push(rows);
      if (level < first_kept_ || rows.empty()) continue;
      int& made = rows_made[static_cast<std::size_t>(level)];
      std::copy(rows.begin(), rows.end(),
                kept_[static_cast<std::size_t>(level - first_kept_)].row(made));
      made += rows.height();
    }
    progress.advance(read);
  }
  const double share = voids / (static_cast<double>(frame.width) * frame.height);
  if (share > parameters.max_void_share)
    throw Error(ErrorKind::input, parameters.sources[0].path,
                fmt::format("{:.1f} % of the terrain is void", 100.0 * share),
                fmt::format("at most {:.1f} % (`max_void_share`); use an `extent` within the data, "
                            "or another source for the gaps",
                            100.0 * parameters.max_void_share));
  if (voids > 0.0)
    progress.note(fmt::format("{:.2f} % of the terrain is void and was filled by interpolation",
                              100.0 * share));
  windows_.note_dropped(progress);
  note_height_range(parameters.sources[0].path, lowest_m, highest_m, progress);
}

Dem DemLevels::whole() const {
  const RasterFrame at = level_frame(frame(), coarsest_);
  Dem dem = make_dem({kept_.back(), at.transform, at.crs});
  dem.halved = coarsest_;
  return dem;
}

Raster<float> DemLevels::blocks() const {
  const RasterFrame& at = frame();
  GeoTransform transform = at.transform;
  transform.cell_x *= blocks_.factor();
  transform.cell_y *= blocks_.factor();
  return {blocks_.means(), transform, at.crs};
}

Grid<float> DemLevels::read_level(int level, const PixelRect& cells) {
  Grid<float> out(cells.width(), cells.height());
  if (level >= first_kept_) {
    const Grid<float>& from = kept_[static_cast<std::size_t>(level - first_kept_)];
    for (int y = 0; y < out.height(); ++y)
      std::copy_n(from.row(cells.y0 + y) + cells.x0, out.width(), out.row(y));
    return out;
  }
  // The cells of level 0 under it, from a cell of the level on, and as many around as all kernels
  // together reach.
  const int factor = 1 << level;
  const PixelRect around = intersection(grown(cells, 4), whole_of(frame(), level));
  const PixelRect finest = {around.x0 * factor, around.y0 * factor,
                            std::min((around.x1 - 1) * factor + 1, frame().width),
                            std::min((around.y1 - 1) * factor + 1, frame().height)};
  // At the end of the raster the last cells of a level may extend beyond it: all remaining cells
  // belong to them.
  const PixelRect all = whole_of(frame(), level);
  const PixelRect read = {finest.x0, finest.y0, around.x1 == all.x1 ? frame().width : finest.x1,
                          around.y1 == all.y1 ? frame().height : finest.y1};
  std::vector<DemRowReducer> reducers;
  for (int i = 0; i < level; ++i)
    reducers.emplace_back(level_cells(read.width(), i), level_cells(read.height(), i));
  int made = around.y0;
  for (int y = read.y0; y < read.y1; y += strip_rows) {
    Grid<float> rows = windows_.read({read.x0, y, read.x1, std::min(y + strip_rows, read.y1)});
    for (int i = 0; i < level && !rows.empty(); ++i)
      rows = reducers[static_cast<std::size_t>(i)].push(rows);
    for (int row = 0; row < rows.height(); ++row, ++made)
      if (made >= cells.y0 && made < cells.y1)
        std::copy_n(rows.row(row) + (cells.x0 - around.x0), out.width(), out.row(made - cells.y0));
  }
  return out;
}

Dem DemLevels::window(int level, const PixelRect& cells, const Dem& whole) {
  const RasterFrame at = level_frame(frame(), level);
  if (level > coarsest_ || cells.empty() ||
      intersection(cells, {0, 0, at.width, at.height}) != cells)
    throw Error(ErrorKind::bug, "levels of a DEM", "the window exceeds the level");
  Dem dem;
  dem.altitude_m = read_level(level, cells);
  dem.filled = Grid<std::uint8_t>(cells.width(), cells.height(), 0);
  dem.crs = at.crs;
  dem.halved = level;
  const glm::dvec2 first = at.transform.to_crs(cells.x0 - 0.5, cells.y0 - 0.5);
  dem.transform = {first.x, first.y, at.transform.cell_x, at.transform.cell_y};
  const double factor = std::ldexp(1.0, coarsest_ - level);
  parallel_rows(cells.height(), [&](int y) {
    for (int x = 0; x < cells.width(); ++x) {
      if (std::isfinite(dem.altitude_m(x, y))) continue;
      dem.filled(x, y) = 1;
      dem.altitude_m(x, y) =
          sample_bspline(whole.altitude_m, (cells.x0 + x) / factor, (cells.y0 + y) / factor);
    }
  });
  resolve(dem.altitude_m, dem.filled);
  return dem;
}

}  // namespace belvedere
