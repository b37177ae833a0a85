#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <type_traits>

#include "base/error.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "terrain/io/crs.h"
#include "terrain/io/dem.h"
#include "terrain/io/raster_file.h"
#include "terrain/io/raster_io.h"
#include "terrain/io/resample.h"

namespace belvedere {
namespace {

// Files whose cells lie on one lattice, read as one file: no seam at their borders, for any kernel.
struct Layer {
  struct Part {
    RasterFile file;
    int x0 = 0, y0 = 0;  // of its first cell on the layer's lattice
  };
  std::vector<Part> parts;             // earlier ones take precedence
  CellAffine affine;                   // the first part's
  std::string crs;                     // may be empty without reprojection
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // all parts together, half open

  glm::dvec2 centre() const { return affine.to_crs({0.5 * (x0 + x1), 0.5 * (y0 + y1)}); }
};

// Position of a file's first cell on a layer's lattice, if its cells lie on it at all (to a
// hundredth of a cell).
std::optional<glm::ivec2> place_on(const Layer& layer, const RasterFile& file) {
  const CellAffine& a = layer.affine;
  const CellAffine& b = file.affine();
  if (!same_crs(layer.crs, file.crs())) return std::nullopt;
  const auto near = [](double p, double q, double tolerance) {
    return std::abs(p - q) <= tolerance;
  };
  // Tiles on both sides of the date line are neighbours: whole turns are taken off.
  glm::dvec2 corner{b.x0, b.y0};
  if (!layer.crs.empty() && crs_traits(layer.crs).geographic)
    corner.x += 360.0 * std::round((layer.centre().x - centre_of(file).x) / 360.0);
  const double cell = std::sqrt(std::abs(a.determinant()));
  // Steps must agree so well that the far end of the file is still on the lattice.
  const double steps = 0.01 * cell / std::max(file.width(), file.height());
  if (!near(a.x_column, b.x_column, steps) || !near(a.x_row, b.x_row, steps) ||
      !near(a.y_column, b.y_column, steps) || !near(a.y_row, b.y_row, steps)) {
    return std::nullopt;
  }
  const glm::dvec2 at = a.to_cell(corner);
  const glm::dvec2 whole = glm::round(at);
  if (!near(at.x, whole.x, 0.01) || !near(at.y, whole.y, 0.01) || std::abs(whole.x) > 1e8 ||
      std::abs(whole.y) > 1e8)
    return std::nullopt;
  return glm::ivec2(whole);
}

std::vector<Layer> make_layers(const std::vector<RasterSource>& sources) {
  std::vector<Layer> layers;
  for (const RasterSource& source : sources) {
    RasterFile file(source);
    std::optional<glm::ivec2> position;
    // Only the last layer may grow: a file in between keeps its precedence.
    if (!layers.empty()) position = place_on(layers.back(), file);
    if (!position) {
      layers.emplace_back();
      layers.back().affine = file.affine();
      layers.back().crs = file.crs();
      position = glm::ivec2{0, 0};
    }
    Layer& layer = layers.back();
    const bool first = layer.parts.empty();
    const glm::ivec2 end = *position + glm::ivec2{file.width(), file.height()};
    layer.x0 = first ? position->x : std::min(layer.x0, position->x);
    layer.y0 = first ? position->y : std::min(layer.y0, position->y);
    layer.x1 = first ? end.x : std::max(layer.x1, end.x);
    layer.y1 = first ? end.y : std::max(layer.y1, end.y);
    layer.parts.push_back({std::move(file), position->x, position->y});
  }
  return layers;
}

template <class T>
bool is_void(T value) {
  if constexpr (std::is_floating_point_v<T>)
    return std::isnan(value);
  else
    return value < 0;
}

template <class T>
constexpr T void_of() {
  if constexpr (std::is_floating_point_v<T>)
    return std::numeric_limits<T>::quiet_NaN();
  else
    return T{-1};
}

// The part of a layer in a window; void outside its files and in their voids.
template <class T>
Grid<T> read_window(const Layer& layer, const CellWindow& window) {
  Grid<T> out(window.width, window.height, void_of<T>());
  for (const Layer::Part& part : layer.parts) {
    const int x0 = std::max(window.x0, part.x0);
    const int y0 = std::max(window.y0, part.y0);
    const int x1 = std::min(window.x0 + window.width, part.x0 + part.file.width());
    const int y1 = std::min(window.y0 + window.height, part.y0 + part.file.height());
    if (x0 >= x1 || y0 >= y1) continue;
    const CellWindow inner{x0 - part.x0, y0 - part.y0, x1 - x0, y1 - y0};
    Grid<T> cells;
    if constexpr (std::is_floating_point_v<T>)
      cells = part.file.read_values(inner);
    else
      cells = part.file.read_codes(inner);
    if (cells.same_size(out) && layer.parts.size() == 1) return cells;
    for (int y = 0; y < cells.height(); ++y)
      for (int x = 0; x < cells.width(); ++x) {
        T& to = out(x0 - window.x0 + x, y0 - window.y0 + y);
        if (is_void(to)) to = cells(x, y);
      }
  }
  return out;
}

// The same if cells of the frame are cells of the layer: a kernel of one cell's width has no weight
// at other centres and is not evaluated.
template <class T>
void copy_tile(const Layer& layer, glm::ivec2 offset, const PixelRect& tile, Grid<T>& out) {
  const PixelRect known =
      intersection(moved(tile, offset.x, offset.y), {layer.x0, layer.y0, layer.x1, layer.y1});
  if (known.empty()) return;
  const Grid<T> cells = read_window<T>(layer, {known.x0, known.y0, known.width(), known.height()});
  for (int y = 0; y < cells.height(); ++y) {
    const T* from = cells.row(y);
    T* to = out.row(known.y0 - offset.y + y) + (known.x0 - offset.x);
    for (int x = 0; x < cells.width(); ++x) to[x] = is_void(to[x]) ? from[x] : to[x];
  }
}

// Fills the remaining voids of one tile of the frame from a layer. Halves the tile if it needs too
// many cells of the layer at once; each cell's value depends only on its own position, so the
// division does not affect the result.
template <class T>
void warp_tile(const Layer& layer, const LatticeMap& map, const PixelRect& tile, Grid<T>& out) {
  const Resampler resampler(map.scale());
  double x0 = std::numeric_limits<double>::infinity(), y0 = x0, x1 = -x0, y1 = -x0;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      if (!is_void(out(x, y))) continue;
      const glm::dvec2 at = map(x, y);
      if (!std::isfinite(at.x) || !std::isfinite(at.y)) continue;
      x0 = std::min(x0, at.x);
      y0 = std::min(y0, at.y);
      x1 = std::max(x1, at.x);
      y1 = std::max(y1, at.y);
    }
  const glm::ivec2 reach = resampler.reach();
  x0 = std::max(std::floor(x0) - reach.x, static_cast<double>(layer.x0));
  y0 = std::max(std::floor(y0) - reach.y, static_cast<double>(layer.y0));
  x1 = std::min(std::ceil(x1) + reach.x + 1.0, static_cast<double>(layer.x1));
  y1 = std::min(std::ceil(y1) + reach.y + 1.0, static_cast<double>(layer.y1));
  if (!(x0 < x1) || !(y0 < y1)) return;
  constexpr double max_cells = 16e6;
  if ((x1 - x0) * (y1 - y0) > max_cells && (tile.width() > 1 || tile.height() > 1)) {
    const bool wide = tile.width() >= tile.height();
    const int half = wide ? (tile.x0 + tile.x1) / 2 : (tile.y0 + tile.y1) / 2;
    warp_tile(layer, map,
              wide ? PixelRect{tile.x0, tile.y0, half, tile.y1}
                   : PixelRect{tile.x0, tile.y0, tile.x1, half},
              out);
    warp_tile(layer, map,
              wide ? PixelRect{half, tile.y0, tile.x1, tile.y1}
                   : PixelRect{tile.x0, half, tile.x1, tile.y1},
              out);
    return;
  }
  const CellWindow window{static_cast<int>(x0), static_cast<int>(y0), static_cast<int>(x1 - x0),
                          static_cast<int>(y1 - y0)};
  const Grid<T> cells = read_window<T>(layer, window);
  parallel_rows(tile.height(), [&](int row) {
    const int y = tile.y0 + row;
    for (int x = tile.x0; x < tile.x1; ++x) {
      T& value = out(x, y);
      if (!is_void(value)) continue;
      const glm::dvec2 at = map(x, y) - glm::dvec2{window.x0, window.y0};
      if (!std::isfinite(at.x) || !std::isfinite(at.y)) continue;
      if constexpr (std::is_floating_point_v<T>)
        value = resampler.sample(cells, at);
      else
        value = sample_nearest(cells, at);
    }
  });
}

void note_dropped(const std::vector<Layer>& layers, Progress& progress) {
  for (const Layer& layer : layers)
    for (const Layer::Part& part : layer.parts) note_dropped_cells(part.file, progress);
}

void check_frame(const RasterFrame& frame, double bytes_per_cell) {
  constexpr int longest = 1 << 20;
  const GeoTransform& t = frame.transform;
  if (frame.width < 1 || frame.height < 1 || !(t.cell_x > 0.0) || !(t.cell_y > 0.0))
    throw Error(ErrorKind::bug, "frame", "has no cells");
  const std::string where = fmt::format("terrain of {} × {} cells", frame.width, frame.height);
  if (frame.width > longest || frame.height > longest)
    throw Error(ErrorKind::limit, where, "too large",
                fmt::format("at most {} cells per side", longest));
  check_memory(where, bytes_per_cell * frame.width * frame.height);
}

constexpr int tile_side = 512;

// Fills the remaining voids of a window of the frame, in which the map starts. Tiles one after
// another, because a file is read by one thread; rows of a tile in parallel.
template <class T>
void fill_from_layer(const Layer& layer, const LatticeMap& map, Grid<T>& out, Progress& progress) {
  for (int y = 0; y < out.height(); y += tile_side)
    for (int x = 0; x < out.width(); x += tile_side) {
      const PixelRect tile{x, y, std::min(x + tile_side, out.width()),
                           std::min(y + tile_side, out.height())};
      map.offset() ? copy_tile(layer, *map.offset(), tile, out) : warp_tile(layer, map, tile, out);
      progress.advance(static_cast<double>(tile.width()) * tile.height());
    }
}

template <class T>
Raster<T> warp_layers(std::vector<Layer>& layers, const RasterFrame& frame, Progress& progress) {
  check_frame(frame, sizeof(T));
  Raster<T> out{Grid<T>(frame.width, frame.height, void_of<T>()), frame.transform, frame.crs};
  for (const Layer& layer : layers) {
    const LatticeMap map(layer.affine, layer.crs, layer.centre(), frame);
    fill_from_layer(layer, map, out.cells, progress);
  }
  return out;
}

template <class T>
Raster<T> warp(const std::vector<RasterSource>& sources, const RasterFrame& frame,
               Progress& progress, std::string_view stage) {
  std::vector<Layer> layers = make_layers(sources);
  for (const Layer& layer : layers)
    for (const Layer::Part& part : layer.parts) part.file.required_crs();
  progress.begin(
      stage, static_cast<double>(frame.width) * frame.height * static_cast<double>(layers.size()));
  Raster<T> out = warp_layers<T>(layers, frame, progress);
  if constexpr (std::is_floating_point_v<T>) note_dropped(layers, progress);
  return out;
}

// The frame of one file in its own CRS: its own cells, or upright cells of the same area over its
// bounding box.
RasterFrame own_frame(const RasterFile& file) {
  const CellAffine& a = file.affine();
  const glm::dvec2 end{file.width(), file.height()};
  const glm::dvec2 corners[] = {a.to_crs({0.0, 0.0}), a.to_crs({end.x, 0.0}),
                                a.to_crs({0.0, end.y}), a.to_crs(end)};
  glm::dvec2 low = corners[0], high = corners[0];
  for (const glm::dvec2& corner : corners) {
    low = glm::min(low, corner);
    high = glm::max(high, corner);
  }
  RasterFrame frame;
  frame.crs = file.crs();
  frame.width = file.width();
  frame.height = file.height();
  frame.transform = {low.x, high.y, std::abs(a.x_column), std::abs(a.y_row)};
  if (!a.axis_aligned()) {
    const double cell = std::sqrt(std::abs(a.determinant()));
    frame.transform.cell_x = frame.transform.cell_y = cell;
    frame.width = static_cast<int>(std::ceil((high.x - low.x) / cell - 1e-6));
    frame.height = static_cast<int>(std::ceil((high.y - low.y) / cell - 1e-6));
  }
  return frame;
}

template <class T>
Raster<T> read_upright(const RasterSource& source, Progress& progress) {
  std::vector<Layer> layers = make_layers({source});
  const RasterFrame frame = own_frame(layers[0].parts[0].file);
  Raster<T> out = warp_layers<T>(layers, frame, silent_progress());
  if constexpr (std::is_floating_point_v<T>) note_dropped(layers, progress);
  return out;
}

}  // namespace

RasterInfo read_raster_info(const RasterSource& source) {
  const RasterFile file(source);
  const RasterFrame frame = own_frame(file);
  RasterInfo info;
  info.width = frame.width;
  info.height = frame.height;
  info.bands = file.bands();
  info.transform = frame.transform;
  info.crs = file.crs();
  info.geographic = !info.crs.empty() && crs_traits(info.crs).geographic;
  info.nodata = file.nodata();
  info.driver = file.driver();
  return info;
}

Raster<float> read_raster(const RasterSource& source, Progress& progress) {
  return read_upright<float>(source, progress);
}

Raster<std::int32_t> read_codes(const RasterSource& source) {
  return read_upright<std::int32_t>(source, silent_progress());
}

Raster<float> warp_rasters(const std::vector<RasterSource>& sources, const RasterFrame& frame,
                           Progress& progress) {
  return warp<float>(sources, frame, progress, "read terrain");
}

Raster<std::int32_t> warp_codes(const std::vector<RasterSource>& sources, const RasterFrame& frame,
                                Progress& progress) {
  return warp<std::int32_t>(sources, frame, progress, "read land cover");
}

struct RasterWindows::State {
  std::vector<Layer> layers;
  std::vector<LatticeMap> maps;  // of each layer
};

RasterWindows::RasterWindows(const std::vector<RasterSource>& sources, const RasterFrame& frame)
    : frame_(frame), state_(std::make_unique<State>()) {
  check_frame(frame, 0.0);
  state_->layers = make_layers(sources);
  for (const Layer& layer : state_->layers) {
    for (const Layer::Part& part : layer.parts) part.file.required_crs();
    state_->maps.emplace_back(layer.affine, layer.crs, layer.centre(), frame);
  }
}

RasterWindows::~RasterWindows() = default;

void RasterWindows::note_dropped(Progress& progress) const {
  belvedere::note_dropped(state_->layers, progress);
}

Grid<float> RasterWindows::read(const PixelRect& window) {
  if (window.empty() || intersection(window, {0, 0, frame_.width, frame_.height}) != window)
    throw Error(ErrorKind::bug, "raster windows", "the window exceeds the frame");
  check_memory(fmt::format("terrain of {} × {} cells", window.width(), window.height()),
               static_cast<double>(sizeof(float)) * window.width() * window.height());
  Grid<float> out(window.width(), window.height(), void_of<float>());
  for (std::size_t i = 0; i < state_->layers.size(); ++i) {
    state_->maps[i].begin_at({window.x0, window.y0});
    fill_from_layer(state_->layers[i], state_->maps[i], out, silent_progress());
  }
  return out;
}

}  // namespace belvedere
