#include "terrain/fetch/tile_mosaic.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <type_traits>

#include "base/cache/content_hash.h"
#include "base/error.h"
#include "terrain/io/crs.h"
#include "terrain/io/http_access.h"
#include "terrain/io/raster_file.h"

namespace belvedere {
namespace {

constexpr int margin_cells = 6;  // around the area, for resampling

int floor_div(int a, int b) { return static_cast<int>(std::floor(static_cast<double>(a) / b)); }

}  // namespace

std::vector<PartPlan> plan_parts(const MapSource& source, const DegreeBox& box, int step) {
  const TileLattice any{source, source.columns.front().count, step};  // rows are the same in all
  const int last_row =
      static_cast<int>(std::lround((source.origin_deg.y + 90.0) / any.height_deg())) +
      (source.on_lines ? 1 : 0);
  const int top =
      std::max(0, static_cast<int>(std::floor(any.row_at(box.north))) - margin_cells * step);
  const int bottom =
      std::min(last_row, static_cast<int>(std::ceil(any.row_at(box.south))) + margin_cells * step);
  std::vector<PartPlan> parts;
  for (int row = top / source.rows; row * source.rows < bottom; ++row) {
    const TileLattice lattice{source, tile_columns(source, row), step};
    const int y0 = lattice.first_from(std::max(top, row * source.rows));
    const int y1 = lattice.first_from(std::min(bottom, (row + 1) * source.rows));
    if (y0 >= y1) continue;
    if (!parts.empty() && parts.back().lattice.columns == lattice.columns) {
      parts.back().y1 = y1;
      continue;
    }
    const int x0 = lattice.first_from(static_cast<int>(std::floor(lattice.column_at(box.west))) -
                                      margin_cells * step);
    const int x1 = lattice.first_from(static_cast<int>(std::ceil(lattice.column_at(box.east))) +
                                      margin_cells * step);
    parts.push_back({lattice, x0, y0, x1, y1});
  }
  return parts;
}

std::vector<TileCells> tiles_of_part(const PartPlan& part) {
  const TileLattice& lattice = part.lattice;
  std::vector<TileCells> tiles;
  const int rows = lattice.source.rows;
  for (int row = floor_div(lattice.source_cell(part.y0), rows);
       row * rows <= lattice.source_cell(part.y1 - 1); ++row)
    for (int column = floor_div(lattice.source_cell(part.x0), lattice.columns);
         column * lattice.columns <= lattice.source_cell(part.x1 - 1); ++column) {
      const TileCells cells{{column, row},
                            std::max(part.x0, lattice.first_from(column * lattice.columns)),
                            std::max(part.y0, lattice.first_from(row * rows)),
                            std::min(part.x1, lattice.first_from((column + 1) * lattice.columns)),
                            std::min(part.y1, lattice.first_from((row + 1) * rows))};
      if (cells.x0 < cells.x1 && cells.y0 < cells.y1 && in_latitudes(lattice.source, cells.tile))
        tiles.push_back(cells);
    }
  return tiles;
}

MapTile tile_at(const PartPlan& plan, int x, int y) {
  return {floor_div(plan.lattice.source_cell(x), plan.lattice.columns),
          floor_div(plan.lattice.source_cell(y), plan.lattice.source.rows)};
}

std::vector<MapTile> tiles_of(const MapSource& source, const DegreeBox& box) {
  std::vector<MapTile> tiles;
  for (const PartPlan& plan : plan_parts(source, box, 1))
    for (const TileCells& cells : tiles_of_part(plan)) tiles.push_back(cells.tile);
  return tiles;
}

namespace {

constexpr int max_tiles = 400;

template <class T>
constexpr T void_of() {
  if constexpr (std::is_floating_point_v<T>)
    return std::numeric_limits<T>::quiet_NaN();
  else
    return T{0};
}

// A file must be the tile of its name: another grid would shift mountains.
void check_grid(const RasterFile& file, const TileLattice& lattice, MapTile tile,
                const std::string& address) {
  const MapSource& source = lattice.source;
  const auto fail = [&](const std::string& found, const std::string& allowed) {
    throw Error(ErrorKind::input, address, found, allowed);
  };
  if (file.width() != lattice.columns || file.height() != source.rows)
    fail(fmt::format("the tile has {} × {} cells", file.width(), file.height()),
         fmt::format("{} × {}, as in the source {}", lattice.columns, source.rows, source.id));
  if (!same_crs(file.required_crs(), normalize_crs(source.crs)))
    fail("the tile is in " + describe_crs(file.crs()), source.crs);
  const glm::dvec2 corner = tile_corner(source, tile);
  const CellAffine& a = file.affine();
  const double west = corner.x - lattice.shift() * lattice.width_deg();
  const double north = corner.y + source.tile_deg.y + lattice.shift() * lattice.height_deg();
  constexpr double tolerance = 0.01;  // cells
  const auto near = [](double value, double expected, double unit) {
    return std::abs(value - expected) <= tolerance * unit;
  };
  if (!a.axis_aligned() || !near(a.x0, west, lattice.width_deg()) ||
      !near(a.y0, north, lattice.height_deg()) ||
      !near(a.x_column * file.width(), source.tile_deg.x, lattice.width_deg()) ||
      !near(a.y_row * file.height(), -source.tile_deg.y, lattice.height_deg()))
    fail(fmt::format("the tile begins at {:.6f}, {:.6f}", a.x0, a.y0),
         fmt::format("{:.6f}, {:.6f}, as in the source {}", west, north, source.id));
}

template <class T>
Grid<T> read_cells(const RasterFile& file, const CellWindow& window) {
  if constexpr (std::is_floating_point_v<T>) {
    return file.read_values(window);
  } else {
    const Grid<std::int32_t> codes = file.read_codes(window);
    Grid<T> out(codes.width(), codes.height());
    for (std::size_t i = 0; i < codes.size(); ++i) {
      if (codes[i] > std::numeric_limits<T>::max())
        throw Error(ErrorKind::input, file.source().path,
                    fmt::format("contains the code {}", codes[i]), "codes up to 255");
      out[i] = static_cast<T>(std::max(codes[i], 0));
    }
    return out;
  }
}

// Reads the needed cells of one tile into its part.
template <class T>
std::string read_tile(RemoteFile& remote, const PartPlan& plan, const TileCells& cells,
                      Grid<T>& part, Progress& progress) {
  const TileLattice& lattice = plan.lattice;
  const std::string& address = remote.address();
  StreamFile stream(address.substr(address.rfind('/') + 1),
                    {remote.describe().bytes, [&](std::uint64_t offset, std::size_t count,
                                                  char* to) { remote.read(offset, count, to); }});
  ContentHash hash;
  double done = 0.0;
  try {
    RasterSource source;
    source.path = stream.path();
    const RasterFile file(source);
    check_grid(file, lattice, cells.tile, address);
    const int left = cells.tile.column * lattice.columns;
    const int above = cells.tile.row * lattice.source.rows;
    const int x0 = lattice.source_cell(cells.x0) - left;
    const int x1 = lattice.source_cell(cells.x1 - 1) - left + 1;
    constexpr int strip = 128;  // of output rows: unpacked at once
    for (int y = cells.y0; y < cells.y1; y += strip) {
      const int end = std::min(y + strip, cells.y1);
      const int y0 = lattice.source_cell(y) - above;
      const int y1 = lattice.source_cell(end - 1) - above + 1;
      const Grid<T> read = read_cells<T>(file, {x0, y0, x1 - x0, y1 - y0});
      for (int v = y; v < end; ++v) {
        T* row = part.row(v - plan.y0) + (cells.x0 - plan.x0);
        const T* from = read.row((v - y) * lattice.step);
        for (int u = 0; u < cells.x1 - cells.x0; ++u)
          row[u] = from[static_cast<std::size_t>(u) * static_cast<std::size_t>(lattice.step)];
        hash.add(row, static_cast<std::size_t>(cells.x1 - cells.x0) * sizeof(T));
      }
      const double amount = static_cast<double>(end - y) * (cells.x1 - cells.x0);
      done += amount;
      progress.advance(amount);
    }
  } catch (const Error& error) {
    progress.advance(-done);
    stream.rethrow();
    // The file's name exists only within the program.
    throw Error(error.kind(), error.where() == stream.path() ? address : error.where(),
                error.found(), error.allowed());
  }
  return hash.digits();
}

template <class T>
TileMosaic<T> read_tiles(const std::vector<PartPlan>& plans, const std::string& mirror,
                         const FetchContext& context) {
  TileMosaic<T> mosaic;
  std::size_t count = 0;
  double work = 0.0;
  for (const PartPlan& plan : plans)
    for (const TileCells& cells : tiles_of_part(plan)) {
      ++count;
      work += static_cast<double>(cells.x1 - cells.x0) * (cells.y1 - cells.y0);
    }
  if (plans.empty() || count == 0) return mosaic;
  const MapSource& source = plans.front().lattice.source;
  if (count > max_tiles)
    throw Error(ErrorKind::limit, source.name, fmt::format("{} tiles needed", count),
                fmt::format("at most {}; choose a smaller area", max_tiles));
  context.progress.begin("fetching " + source.name, work);
  for (const PartPlan& plan : plans) {
    Raster<T> part{Grid<T>(plan.x1 - plan.x0, plan.y1 - plan.y0, void_of<T>()),
                   plan.lattice.transform(plan.x0, plan.y0), source.crs};
    for (const TileCells& cells : tiles_of_part(plan)) {
      RemoteFile remote(tile_address(source, cells.tile, mirror), context);
      FetchedTile tile{
          cells.tile, tile_name(source, cells.tile), remote.address(), remote.describe(), {}};
      if (tile.about.missing) {
        context.progress.advance(static_cast<double>(cells.x1 - cells.x0) * (cells.y1 - cells.y0));
      } else {
        try {
          tile.hash = read_tile(remote, plan, cells, part.cells, context.progress);
        } catch (const Error& error) {
          // The received or cached data are damaged: try once more from the beginning. That does
          // not help after an interruption or without a response.
          if (error.kind() != ErrorKind::input || remote.is_lost()) throw;
          context.progress.note(fmt::format("{}: {}; downloading again", tile.name, error.found()));
          remote.forget();
          tile.about = remote.describe();
          if (tile.about.missing) throw;
          tile.hash = read_tile(remote, plan, cells, part.cells, context.progress);
        }
      }
      mosaic.tiles.push_back(std::move(tile));
    }
    mosaic.south.push_back(part.transform.origin_y - part.transform.cell_y * part.cells.height());
    mosaic.parts.push_back(std::move(part));
  }
  const bool none = std::all_of(mosaic.tiles.begin(), mosaic.tiles.end(),
                                [](const FetchedTile& tile) { return tile.about.missing; });
  if (none)
    throw Error(
        ErrorKind::input, mosaic.tiles.front().address,
        fmt::format("{} has none of the {} tiles of this area", source.name, mosaic.tiles.size()),
        "an area with land, and a correct address of the source or mirror");
  return mosaic;
}

// ---- missing tiles

// Groups of adjacent missing tiles, and the altitudes around them.
class MissingGroups {
 public:
  explicit MissingGroups(const std::vector<FetchedTile>& tiles)
      : tiles_(tiles), group_(tiles.size()), sides_(tiles.size()), high_(tiles.size()) {
    std::iota(group_.begin(), group_.end(), std::size_t{0});
    for (std::size_t i = 0; i < tiles.size(); ++i) number_[tiles[i].tile] = i;
  }
  // A cell of one tile is adjacent to one of another.
  void add_side(MapTile a, float altitude_a, MapTile b, float altitude_b) {
    const auto first = number_.find(a);
    const auto second = number_.find(b);
    if (first == number_.end() || second == number_.end()) return;
    const bool missing_a = tiles_[first->second].about.missing;
    const bool missing_b = tiles_[second->second].about.missing;
    if (missing_a && missing_b) group_[root(second->second)] = root(first->second);
    if (missing_a == missing_b) return;
    const std::size_t one = missing_a ? first->second : second->second;
    const float altitude = missing_a ? altitude_b : altitude_a;
    constexpr float level_m = 3.0F;  // seas are level and near 0 in such data
    ++sides_[one];
    if (std::abs(altitude) > level_m) ++high_[one];
  }
  // Names of tiles that cannot be sea: more than a twentieth of the ground next to them is not at
  // its level. A coast may end near a border of tiles by chance, but only along a short part of it.
  std::vector<std::string> dry() {
    std::vector<double> sides(tiles_.size()), high(tiles_.size());
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      sides[root(i)] += sides_[i];
      high[root(i)] += high_[i];
    }
    std::vector<std::string> names;
    for (std::size_t i = 0; i < tiles_.size(); ++i)
      if (tiles_[i].about.missing && high[root(i)] > 0.05 * sides[root(i)])
        names.push_back(tiles_[i].name);
    return names;
  }

 private:
  std::size_t root(std::size_t i) const {
    while (group_[i] != i) i = group_[i];
    return i;
  }
  const std::vector<FetchedTile>& tiles_;
  std::map<MapTile, std::size_t> number_;
  std::vector<std::size_t> group_;
  std::vector<int> sides_, high_;
};

// All pairs of cells on both sides of borders of tiles.
void look_at_borders(const std::vector<PartPlan>& plans, const std::vector<Raster<float>>& parts,
                     MissingGroups& groups) {
  for (std::size_t p = 0; p < plans.size(); ++p) {
    const PartPlan& plan = plans[p];
    const Grid<float>& cells = parts[p].cells;
    const auto value = [&](int x, int y) { return cells(x - plan.x0, y - plan.y0); };
    for (int x = plan.x0 + 1; x < plan.x1; ++x) {
      if (tile_at(plan, x, plan.y0).column == tile_at(plan, x - 1, plan.y0).column) continue;
      for (int y = plan.y0; y < plan.y1; ++y)
        groups.add_side(tile_at(plan, x - 1, y), value(x - 1, y), tile_at(plan, x, y), value(x, y));
    }
    for (int y = plan.y0 + 1; y < plan.y1; ++y) {
      if (tile_at(plan, plan.x0, y).row == tile_at(plan, plan.x0, y - 1).row) continue;
      for (int x = plan.x0; x < plan.x1; ++x)
        groups.add_side(tile_at(plan, x, y - 1), value(x, y - 1), tile_at(plan, x, y), value(x, y));
    }
    if (p == 0) continue;
    // The last row of the part above, whose cells have another width.
    const PartPlan& above = plans[p - 1];
    for (int x = plan.x0; x < plan.x1; ++x) {
      const double longitude = parts[p].transform.to_crs(x - plan.x0, 0).x;
      const int there =
          static_cast<int>(std::floor(above.lattice.column_at(longitude) / above.lattice.step));
      if (there < above.x0 || there >= above.x1) continue;
      groups.add_side(tile_at(above, there, above.y1 - 1),
                      parts[p - 1].cells(there - above.x0, above.y1 - 1 - above.y0),
                      tile_at(plan, x, plan.y0), value(x, plan.y0));
    }
  }
}

void fill_tile(const std::vector<PartPlan>& plans, std::vector<Raster<float>>& parts, MapTile tile,
               float value) {
  for (std::size_t p = 0; p < plans.size(); ++p)
    for (const TileCells& cells : tiles_of_part(plans[p])) {
      if (cells.tile != tile) continue;
      for (int y = cells.y0; y < cells.y1; ++y)
        std::fill_n(parts[p].cells.row(y - plans[p].y0) + (cells.x0 - plans[p].x0),
                    cells.x1 - cells.x0, value);
    }
}

// ---- parts with cells of several widths

// A row of a part at the columns of another: linear between cells.
void resample_row(const Raster<float>& from, int row, const Raster<float>& to, float* out) {
  for (int x = 0; x < to.cells.width(); ++x) {
    const double at = from.transform.to_cell(to.transform.to_crs(x, 0).x, 0.0).x;
    const int left = static_cast<int>(std::floor(at));
    const float t = static_cast<float>(at - left);
    const float a = from.cells.clamped(left, row);
    const float b = from.cells.clamped(left + 1, row);
    out[x] = t == 0.0F ? a : (1.0F - t) * a + t * b;
  }
}

// Each part gets the adjacent rows of its neighbours; otherwise there would be a seam where cells
// change their width.
std::vector<Raster<float>> with_shared_rows(const std::vector<Raster<float>>& parts,
                                            int shared_rows) {
  std::vector<Raster<float>> out;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Raster<float>& part = parts[p];
    const int above = p == 0 ? 0 : std::min(shared_rows, parts[p - 1].cells.height());
    const int below =
        p + 1 == parts.size() ? 0 : std::min(shared_rows, parts[p + 1].cells.height());
    Raster<float> wider{Grid<float>(part.cells.width(), above + part.cells.height() + below),
                        part.transform, part.crs};
    wider.transform.origin_y += above * part.transform.cell_y;
    std::copy(part.cells.begin(), part.cells.end(),
              wider.cells.begin() + static_cast<std::ptrdiff_t>(wider.cells.index(0, above)));
    for (int i = 0; i < above; ++i)
      resample_row(parts[p - 1], parts[p - 1].cells.height() - above + i, wider,
                   wider.cells.row(i));
    for (int i = 0; i < below; ++i)
      resample_row(parts[p + 1], i, wider, wider.cells.row(above + part.cells.height() + i));
    out.push_back(std::move(wider));
  }
  return out;
}

std::vector<std::string> missing_names(const std::vector<FetchedTile>& tiles) {
  std::vector<std::string> names;
  for (const FetchedTile& tile : tiles)
    if (tile.about.missing) names.push_back(tile.name);
  return names;
}

void refuse_missing(const MapSource& source, const std::vector<FetchedTile>& tiles) {
  const std::vector<std::string> names = missing_names(tiles);
  if (source.missing == MissingTile::error && !names.empty())
    throw Error(ErrorKind::input, source.name,
                fmt::format("the service lacks the tiles {}", fmt::join(names, ", ")),
                "another area or source");
}

}  // namespace

TileMosaic<float> read_elevation_tiles(const MapSource& source, const DegreeBox& box,
                                       const std::string& mirror, const FetchContext& context,
                                       int shared_rows) {
  const std::vector<PartPlan> plans = plan_parts(source, box, 1);
  TileMosaic<float> mosaic = read_tiles<float>(plans, mirror, context);
  if (mosaic.tiles.empty())
    throw Error(ErrorKind::input, source.name, "the area is outside the coverage of the service",
                fmt::format("latitudes {} … {}", source.latitudes[0], source.latitudes[1]));
  refuse_missing(source, mosaic.tiles);
  const std::vector<std::string> missing = missing_names(mosaic.tiles);
  if (source.missing == MissingTile::sea && !missing.empty()) {
    MissingGroups groups(mosaic.tiles);
    look_at_borders(plans, mosaic.parts, groups);
    if (const std::vector<std::string> dry = groups.dry(); !dry.empty())
      throw Error(
          ErrorKind::input, source.name,
          fmt::format("the service lacks the tiles {}, and the ground next to them is not sea",
                      fmt::join(dry, ", ")),
          "another source, such as copernicus_glo90, or another area");
    for (const FetchedTile& tile : mosaic.tiles)
      if (tile.about.missing)
        fill_tile(plans, mosaic.parts, tile.tile, static_cast<float>(source.sea_value));
    context.progress.note(
        fmt::format("{}: missing tiles taken as sea: {}", source.name, fmt::join(missing, ", ")));
  }
  if (mosaic.parts.size() > 1) mosaic.parts = with_shared_rows(mosaic.parts, shared_rows);
  return mosaic;
}

TileMosaic<std::uint8_t> read_cover_tiles(const MapSource& source, const DegreeBox& box, int step,
                                          const std::string& mirror, const FetchContext& context) {
  TileMosaic<std::uint8_t> mosaic =
      read_tiles<std::uint8_t>(plan_parts(source, box, step), mirror, context);
  refuse_missing(source, mosaic.tiles);
  return mosaic;
}

}  // namespace belvedere
